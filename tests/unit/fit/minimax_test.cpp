#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "unit/fit/tables.hpp"

namespace repose::fit {
namespace {

using test::Noise;

double worst_error(const PowerSolution& fit) { return fit.residual.cwiseAbs().maxCoeff(); }

PowerProblem random_problem(Noise& noise, Eigen::Index points, Eigen::Index factors, double deviation = 2.0) {
  PowerProblem problem{Eigen::MatrixXd(points, factors), Eigen::VectorXd(points)};
  for (Eigen::Index i = 0; i < points; ++i) {
    double log_angle = std::log(55.0);
    for (Eigen::Index k = 0; k < factors; ++k) {
      problem.log_factors(i, k) = std::log(0.05 + 0.9 * noise.uniform());
      log_angle += (0.1 + 0.2 * static_cast<double>(k)) * problem.log_factors(i, k);
    }
    problem.response(i) = std::exp(log_angle) + deviation * noise.normal();
  }
  return problem;
}

PowerSolution minimax_of(const PowerProblem& problem) {
  return solve_minimax(problem, solve_least_squares(problem, log_linear_start(problem)).theta);
}

// By how much the strips ln(y − t) ≤ p + q x ≤ ln(y + t) fail to have a line in common, smallest over the
// slope q: a convex function of q, searched by thirds.
double strip_gap(const PowerProblem& problem, double t) {
  const auto gap = [&](double q) {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < problem.response.size(); ++i) {
      const double y = problem.response(i);
      const double x = problem.log_factors(i, 0);
      if (y > t) lower = std::max(lower, std::log(y - t) - q * x);
      upper = std::min(upper, std::log(y + t) - q * x);
    }
    return lower - upper;
  };
  double left = -50.0;
  double right = 50.0;
  for (int i = 0; i < 120; ++i) {
    const double p = left + (right - left) / 3.0;
    const double q = right - (right - left) / 3.0;
    (gap(p) < gap(q) ? right : left) = gap(p) < gap(q) ? q : p;
  }
  return gap(0.5 * (left + right));
}

double brute_force(const PowerProblem& problem) {
  double low = 0.0;
  double high = problem.response.maxCoeff();
  for (int i = 0; i < 70; ++i) {
    const double t = 0.5 * (low + high);
    (strip_gap(problem, t) <= 0.0 ? high : low) = t;
  }
  return high;
}

// Tolerance: 1e-8 relative, that of the search by thirds in the reference.
TEST(Minimax, OneFactorAgreesWithASearchOverAllLines) {
  Noise noise(11);
  for (int set = 0; set < 60; ++set) {
    const PowerProblem problem = random_problem(noise, 3 + set % 8, 1);
    const double reference = brute_force(problem);
    EXPECT_NEAR(worst_error(minimax_of(problem)), reference, 1e-8 * reference) << "set " << set;
  }
}

// The optimum of a smooth minimax with p parameters in general position has p + 1 points at the worst error,
// and their signed gradients hold 0 in their convex hull (Kolmogorov's criterion), which is sufficient here
// because every local minimum is global. Tolerance 1e-7: weights may be 0 but for rounding.
TEST(Minimax, ThreeFactorsMeetKolmogorovsCriterion) {
  Noise noise(5);
  for (int set = 0; set < 200; ++set) {
    const PowerProblem problem = random_problem(noise, 6 + set % 30, 3, set % 2 == 0 ? 2.0 : 0.02);
    const PowerSolution fit = minimax_of(problem);
    const double worst = worst_error(fit);
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < fit.residual.size(); ++i) {
      if (std::abs(fit.residual(i)) > (1.0 - 1e-7) * worst) active.push_back(i);
    }
    EXPECT_LT(fit.optimality, 1e-11) << "set " << set;
    ASSERT_EQ(active.size(), 5U) << "set " << set;
    Eigen::MatrixXd gradients(4, 5);
    for (Eigen::Index k = 0; k < 5; ++k) {
      const Eigen::Index i = active[static_cast<std::size_t>(k)];
      gradients.col(k) = std::copysign(1.0, fit.residual(i)) * fit.jacobian.row(i).transpose();
    }
    Eigen::VectorXd weights = Eigen::FullPivLU<Eigen::MatrixXd>(gradients).kernel().col(0);
    weights /= weights.sum();
    EXPECT_GE(weights.minCoeff(), -1e-7) << "set " << set;
  }
}

TEST(Minimax, DoesNotDependOnTheStart) {
  Noise noise(21);
  for (int set = 0; set < 50; ++set) {
    const PowerProblem problem = random_problem(noise, 30, 3, 0.5);
    const double worst = worst_error(minimax_of(problem));
    const Eigen::Vector4d far(1.0, -0.5, 0.5, 1.0);
    EXPECT_NEAR(worst_error(solve_minimax(problem, far)), worst, 1e-10 * worst) << "set " << set;
  }
}

TEST(Minimax, NeverHasALargerWorstErrorThanLeastSquares) {
  Noise noise(3);
  for (int set = 0; set < 20; ++set) {
    const PowerProblem problem = random_problem(noise, 40, 2);
    const PowerSolution squares = solve_least_squares(problem, log_linear_start(problem));
    const PowerSolution minimax = solve_minimax(problem, squares.theta);
    EXPECT_LT(worst_error(minimax), worst_error(squares));
    EXPECT_GT(minimax.residual.squaredNorm(), squares.residual.squaredNorm());
  }
}

TEST(Minimax, ReturnsDataWithoutErrorAsTheyAre) {
  const PowerLaw law = fit_power_law(test::article_table(), Loss::minimax);
  EXPECT_NEAR(law.C.value, test::kC, 1e-9);
  EXPECT_NEAR(law.c.value, test::kExponentS, 1e-11);
  EXPECT_LT(law.worst_error, 1e-10);
}

// Two repeats 4° apart at one point: no curve does better than 2° there.
TEST(Minimax, RepeatsBoundTheWorstErrorFromBelow) {
  std::vector<Observation> table = test::article_table();
  table.push_back(table.front());
  table.front().angle -= 2.0;
  table.back().angle += 2.0;
  EXPECT_NEAR(fit_power_law(table, Loss::minimax).worst_error, 2.0, 1e-9);
}

}  // namespace
}  // namespace repose::fit
