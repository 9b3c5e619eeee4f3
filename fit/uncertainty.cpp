#include "fit/uncertainty.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "fit/distributions.hpp"

namespace repose::fit {
namespace {

constexpr int kRefits = 200;               // a standard error to about 5 %
constexpr std::uint64_t kSeed = 20170520;  // any number: fixed, so that a fit is a function of its table
constexpr double kPoolingLevel = 0.25;

// A mean square below this, relative to the mean angle, is that of the arithmetic: exact data lack no fit.
constexpr double kRoundingAlone = 1e-9;

// Sum of squares of the rows about the mean of their distinct point.
double pure_error_sum(const Eigen::VectorXd& response, const std::vector<int>& point_of, int points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(points);
  for (Eigen::Index i = 0; i < response.size(); ++i) {
    sum(point_of[static_cast<std::size_t>(i)]) += response(i);
    count(point_of[static_cast<std::size_t>(i)]) += 1.0;
  }
  double total = 0.0;
  for (Eigen::Index i = 0; i < response.size(); ++i) {
    const int point = point_of[static_cast<std::size_t>(i)];
    total += std::pow(response(i) - sum(point) / count(point), 2);
  }
  return total;
}

/// (JᵀJ)⁻¹
Eigen::MatrixXd inverse_of_squares(const Eigen::MatrixXd& jacobian) {
  const Eigen::Index size = jacobian.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const Eigen::MatrixXd inverse =
      qr.matrixQR().topRows(size).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(size, size));
  return inverse * inverse.transpose();
}

/// s_p, a row for every place: rows of the Jacobian that share the law's misfit, added up.
Eigen::MatrixXd by_place(const Eigen::MatrixXd& jacobian, const Selection& selection) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(selection.places, jacobian.cols());
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
    sums.row(selection.place_of[static_cast<std::size_t>(i)]) += jacobian.row(i);
  return sums;
}

/// τ² of a lack of fit: of its sum of squares τ² has N − tr((JᵀJ)⁻¹ Σ s_p s_pᵀ), σ² its degrees of freedom.
double misfit_variance(const PowerSolution& fit, const Selection& selection, double lack, double freedom,
                       double own) {
  const Eigen::MatrixXd sums = by_place(fit.jacobian, selection);
  const double share = static_cast<double>(fit.jacobian.rows()) -
                       (inverse_of_squares(fit.jacobian) * (sums.transpose() * sums)).trace();
  return share > 0.0 ? std::max(0.0, (lack - freedom * own) / share) : 0.0;
}

}  // namespace

ErrorModel judge_error(const PowerSolution& fit, const PowerProblem& problem, const Selection& selection) {
  const auto rows = static_cast<double>(problem.response.size()),
             points = static_cast<double>(selection.distinct_points),
             parameters = static_cast<double>(fit.theta.size());
  const double total = fit.residual.squaredNorm();
  ErrorModel error;
  error.degrees_of_freedom = rows - parameters;
  error.standard_deviation = std::sqrt(total / error.degrees_of_freedom);
  if (rows <= points) return error;

  const double pure = pure_error_sum(problem.response, selection.point_of, selection.distinct_points);
  const double pure_mean_square = pure / (rows - points);
  error.pure_error = std::sqrt(pure_mean_square);
  const double freedom = points - parameters;
  if (!(freedom > 0.0)) {
    error.degrees_of_freedom = rows - points;
    error.standard_deviation = error.pure_error;
    return error;
  }
  const double lack = std::max(0.0, total - pure);
  const bool exact = std::sqrt(lack / freedom) <= kRoundingAlone * problem.response.mean();
  error.lack_of_fit_p = f_upper_tail(exact ? 0.0 : lack / freedom / pure_mean_square, freedom, rows - points);
  if (error.lack_of_fit_p < kPoolingLevel) {
    const double variance = misfit_variance(fit, selection, lack, freedom, pure_mean_square);
    // Tests at the same factors share the misfit there: so many of them tell of it.
    const double of_places = static_cast<double>(selection.places) - parameters;
    error.degrees_of_freedom = of_places > 0.0 ? std::min(freedom, of_places) : freedom;
    error.misfit = std::sqrt(variance);
    error.standard_deviation = std::sqrt(variance + pure_mean_square);
  }
  return error;
}

Eigen::MatrixXd least_squares_covariance(const PowerSolution& fit, const Selection& selection,
                                         const ErrorModel& error) {
  const Eigen::MatrixXd inverse = inverse_of_squares(fit.jacobian);
  const Eigen::MatrixXd sums = error.misfit * by_place(fit.jacobian, selection) * inverse;
  return error.own_variance() * inverse + sums.transpose() * sums;
}

Eigen::MatrixXd minimax_covariance(const PowerProblem& problem, const PowerSolution& least_squares,
                                   const Selection& selection, const ErrorModel& error) {
  const Eigen::Index rows = problem.response.size();
  const double own = std::sqrt(error.own_variance());
  const Eigen::VectorXd law = problem.response + least_squares.residual;
  std::mt19937_64 draw(kSeed);  // its numbers are fixed by the standard, unlike those of distributions
  const auto normal = [&draw] {
    const double uniform = (static_cast<double>(draw() >> 11) + 0.5) * 0x1.0p-53;
    return student_t_quantile(uniform, std::numeric_limits<double>::infinity());
  };
  Eigen::MatrixXd thetas(kRefits, least_squares.theta.size());
  PowerProblem drawn = problem;
  std::vector<double> misfit(static_cast<std::size_t>(selection.places));
  for (int refit = 0; refit < kRefits; ++refit) {
    for (double& shared : misfit) shared = error.misfit * normal();
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto place = static_cast<std::size_t>(selection.place_of[static_cast<std::size_t>(i)]);
      // A flat heap may draw an error larger than its angle; an angle stays above 0.
      drawn.response(i) = std::max(law(i) + misfit[place] + own * normal(), 1e-3 * law(i));
    }
    thetas.row(refit) = solve_minimax(drawn, least_squares.theta).theta.transpose();
  }
  const Eigen::MatrixXd deviation = thetas.rowwise() - thetas.colwise().mean();
  return deviation.transpose() * deviation / static_cast<double>(kRefits - 1);
}

}  // namespace repose::fit
