// NIST Statistical Reference Datasets, nonlinear regression, DanWood: y = b1 x^b2, the power law with one
// factor. Certified values to eleven digits: https://www.itl.nist.gov/div898/strd/nls/data/daniel_wood.shtml
#include <gtest/gtest.h>

#include <cmath>

#include "unit/fit/tables.hpp"

namespace repose::fit {
namespace {

constexpr double kB1 = 0.76886226176, kB2 = 3.8604055871;
constexpr double kSd1 = 1.8281973860e-2, kSd2 = 5.1726610913e-2;
constexpr double kRss = 4.3173084083e-3, kResidualSd = 3.2853114039e-2;
const Eigen::VectorXd kX = (Eigen::VectorXd(6) << 1.309, 1.471, 1.490, 1.565, 1.611, 1.680).finished();
const Eigen::VectorXd kY = (Eigen::VectorXd(6) << 2.138, 3.421, 3.597, 4.340, 4.882, 5.660).finished();

PowerProblem danwood() { return {kX.array().log().matrix(), kY}; }

class DanWood : public testing::TestWithParam<std::pair<double, double>> {};

// Tolerance: a relative 1e-10, the certified values' own last digit.
TEST_P(DanWood, ReachesTheCertifiedValuesFromTheStartsOfNist) {
  const auto [b1, b2] = GetParam();
  const PowerSolution fit = solve_least_squares(danwood(), Eigen::Vector2d(std::log(b1), b2));
  EXPECT_NEAR(std::exp(fit.theta(0)), kB1, 1e-10 * kB1);
  EXPECT_NEAR(fit.theta(1), kB2, 1e-10 * kB2);
  EXPECT_NEAR(fit.residual.squaredNorm(), kRss, 1e-10 * kRss);
  EXPECT_LT(fit.optimality, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Starts, DanWood,
                         testing::Values(std::pair{1.0, 5.0}, std::pair{0.7, 4.0}, std::pair{5.0, 0.1}));

// The same as a table with a column for every factor: e and μr stand still, C takes them up.
TEST(DanWoodTable, GivesTheCertifiedStandardErrors) {
  std::vector<Observation> table;
  for (Eigen::Index i = 0; i < kX.size(); ++i) {
    table.push_back({.e = 0.3, .mu_s = kX(i), .mu_r = 0.1, .angle = kY(i)});
  }
  const PowerLaw law = fit_power_law(table);
  EXPECT_NEAR(law.C.value, kB1, 1e-10 * kB1);
  EXPECT_NEAR(law.c.value, kB2, 1e-10 * kB2);
  EXPECT_NEAR(law.C.standard_error, kSd1, 1e-9 * kSd1);
  EXPECT_NEAR(law.c.standard_error, kSd2, 1e-9 * kSd2);
  EXPECT_NEAR(law.error.standard_deviation, kResidualSd, 1e-9 * kResidualSd);
  EXPECT_EQ(law.error.degrees_of_freedom, 4.0);
  EXPECT_FALSE(law.a.identified);
  EXPECT_FALSE(law.b.identified);
  // t(0.975, 4) = 2.7764451052, from tables.
  EXPECT_NEAR(law.c.interval_95.high - law.c.value, 2.7764451052 * kSd2, 1e-9);
}

}  // namespace
}  // namespace repose::fit
