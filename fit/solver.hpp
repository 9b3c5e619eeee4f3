#pragma once

#include <Eigen/Core>

namespace repose::fit {

/// Fit y = C Π x_k^{p_k} to n points with k factors, in the units of y.
struct PowerProblem {
  Eigen::MatrixXd log_factors;  ///< ln x, n × k
  Eigen::VectorXd response;     ///< y, n
};

/// θ = (ln C, p_1 … p_k) and how good it is.
struct PowerSolution {
  Eigen::VectorXd theta;     ///< k + 1
  Eigen::VectorXd residual;  ///< predicted − y, n
  Eigen::MatrixXd jacobian;  ///< ∂ predicted / ∂θ, n × (k + 1)
  /// Least squares: the gradient made free of units, |projection of the residual on the tangent plane| /
  /// |residual| (the relative offset of Bates & Watts 1981). Minimax: the worst error less its proven lower
  /// bound, over the worst error. Both are 0 at the optimum.
  double optimality = 0.0;
};

/// Least squares of ln y against ln x: a start, exact for data without error. Requires y > 0.
Eigen::VectorXd log_linear_start(const PowerProblem& problem);

/// min over θ of Σ (predicted − y)², not of its logarithm, by NLopt's SLSQP in coordinates in which the
/// Hessian is near the identity, restarted until the gradient vanishes. Where no law is near the points
/// (angles over decades, most of the scatter left) the minimum next to `start` need not be the least one.
/// @param start  θ to begin from, k + 1
/// Requires at least k + 1 points and a full rank of (1, ln x). Throws Unusable if it does not converge.
PowerSolution solve_least_squares(const PowerProblem& problem, const Eigen::VectorXd& start);

/// min over θ of max |predicted − y|, by exchange of the points that bound it; the result is the global
/// optimum, with its proof (minimax.cpp). Where several θ share the worst error, one near `start` is
/// returned.
/// @param start  θ to begin from, best the least-squares solution
/// Requires y > 0, at least k + 2 points and a full rank of (1, ln x).
PowerSolution solve_minimax(const PowerProblem& problem, const Eigen::VectorXd& start);

}  // namespace repose::fit
