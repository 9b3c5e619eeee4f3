#include "fit/uncertainty.hpp"

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "fit/distributions.hpp"

namespace repose::fit {
namespace {

constexpr int kRefits = 200;               // a standard error to about 5 %
constexpr std::uint64_t kSeed = 20170520;  // any number: fixed, so that a fit is a function of its table
constexpr double kPoolingLevel = 0.25;

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

}  // namespace

ErrorModel judge_error(const PowerSolution& fit, const PowerProblem& problem,
                       const std::vector<int>& point_of, int distinct_points) {
  const double rows = static_cast<double>(problem.response.size());
  const double points = distinct_points;
  const double parameters = static_cast<double>(fit.theta.size());
  const double total = fit.residual.squaredNorm();
  ErrorModel error;
  error.degrees_of_freedom = rows - parameters;
  error.standard_deviation = std::sqrt(total / error.degrees_of_freedom);
  if (rows <= points) return error;

  const double pure = pure_error_sum(problem.response, point_of, distinct_points);
  const double pure_mean_square = pure / (rows - points);
  const double lack_mean_square = std::max(0.0, total - pure) / (points - parameters);
  error.pure_error = std::sqrt(pure_mean_square);
  const double ratio = lack_mean_square > 0.0 ? lack_mean_square / pure_mean_square : 0.0;
  error.lack_of_fit_p = f_upper_tail(ratio, points - parameters, rows - points);
  if (error.lack_of_fit_p < kPoolingLevel) {
    error.degrees_of_freedom = points - parameters;
    error.standard_deviation = std::sqrt(lack_mean_square);
  }
  return error;
}

Eigen::MatrixXd jacobian_covariance(const Eigen::MatrixXd& jacobian, double standard_deviation) {
  const Eigen::Index size = jacobian.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian);
  const Eigen::MatrixXd inverse =
      qr.matrixQR().topRows(size).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(size, size));
  return standard_deviation * standard_deviation * (inverse * inverse.transpose());
}

Eigen::MatrixXd minimax_covariance(const PowerProblem& problem, const PowerSolution& least_squares,
                                   const ErrorModel& error) {
  const Eigen::Index rows = problem.response.size();
  const Eigen::Index size = least_squares.theta.size();
  const double rms = std::sqrt(least_squares.residual.squaredNorm() / static_cast<double>(rows));
  const double scale = rms > 0.0 ? error.standard_deviation / rms : 0.0;
  const Eigen::VectorXd law = problem.response + least_squares.residual;
  std::mt19937_64 draw(kSeed);  // its numbers are fixed by the standard, unlike those of distributions
  Eigen::MatrixXd thetas(kRefits, size);
  PowerProblem resampled = problem;
  for (int refit = 0; refit < kRefits; ++refit) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto drawn = static_cast<Eigen::Index>(draw() % static_cast<std::uint64_t>(rows));
      // A flat heap may draw an error larger than its angle; an angle stays above 0.
      resampled.response(i) = std::max(law(i) - scale * least_squares.residual(drawn), 1e-3 * law(i));
    }
    thetas.row(refit) = solve_minimax(resampled, least_squares.theta).theta.transpose();
  }
  const Eigen::MatrixXd deviation = thetas.rowwise() - thetas.colwise().mean();
  return deviation.transpose() * deviation / static_cast<double>(kRefits - 1);
}

}  // namespace repose::fit
