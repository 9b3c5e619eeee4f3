#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/power_law.hpp"
#include "fit/solver.hpp"

namespace repose::fit {

/// The scatter about a least-squares fit, split into that of repeats and that of the law (see fit_power_law).
/// @param point_of         number of the distinct point of each row
/// @param distinct_points  > parameters
ErrorModel judge_error(const PowerSolution& fit, const PowerProblem& problem,
                       const std::vector<int>& point_of, int distinct_points);

/// s² (JᵀJ)⁻¹ of θ, by QR.
Eigen::MatrixXd jacobian_covariance(const Eigen::MatrixXd& jacobian, double standard_deviation);

/// Covariance of the minimax θ over refits to angles = law + errors drawn with replacement from those of the
/// least-squares fit, scaled to the standard deviation of `error`. The same draws on every machine.
Eigen::MatrixXd minimax_covariance(const PowerProblem& problem, const PowerSolution& least_squares,
                                   const ErrorModel& error);

}  // namespace repose::fit
