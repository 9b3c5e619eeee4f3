#include "fit/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace repose::fit {
namespace {

// Tables of the t law (Abramowitz & Stegun, table 26.10; more digits from the closed forms for 1 and 2
// degrees of freedom and from published high-precision tables). Tolerance: the last digit quoted.
TEST(StudentT, QuantilesAgreeWithTables) {
  EXPECT_NEAR(student_t_quantile(0.975, 1), 12.706204736, 1e-8);
  EXPECT_NEAR(student_t_quantile(0.975, 2), 4.3026527297, 1e-9);
  EXPECT_NEAR(student_t_quantile(0.975, 5), 2.5705818366, 1e-8);
  EXPECT_NEAR(student_t_quantile(0.975, 10), 2.2281388520, 1e-9);
  EXPECT_NEAR(student_t_quantile(0.975, 30), 2.0422724563, 1e-9);
  EXPECT_NEAR(student_t_quantile(0.975, 120), 1.9799304051, 1e-9);
  EXPECT_NEAR(student_t_quantile(0.95, 3), 2.353, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.995, 8), 3.355, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.9995, 20), 3.850, 5e-4);
}

TEST(StudentT, OneDegreeOfFreedomIsTheCauchyLaw) {
  for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 0.999999}) {
    const double exact = std::tan(std::numbers::pi * (p - 0.5));
    EXPECT_NEAR(student_t_quantile(p, 1), exact, 1e-9 * std::max(1.0, std::abs(exact)));
  }
}

TEST(StudentT, TwoDegreesOfFreedomHaveAClosedForm) {
  for (const double p : {1e-6, 0.02, 0.4, 0.75, 0.9999}) {
    const double exact = (2.0 * p - 1.0) / std::sqrt(2.0 * p * (1.0 - p));
    EXPECT_NEAR(student_t_quantile(p, 2), exact, 1e-9 * std::max(1.0, std::abs(exact)));
  }
}

TEST(StudentT, ManyDegreesOfFreedomApproachTheNormalLaw) {
  constexpr double kNormal = 1.9599639845400545;
  EXPECT_NEAR(student_t_quantile(0.975, std::numeric_limits<double>::infinity()), kNormal, 1e-12);
  // First term of the expansion about the normal law: z + (z³ + z)/(4ν); the next is of order 1/ν².
  const double nu = 1e6;
  EXPECT_NEAR(student_t_quantile(0.975, nu), kNormal + (std::pow(kNormal, 3) + kNormal) / (4 * nu), 1e-9);
}

// Tables of the F law at 5 %: F(1, 1) = 161.45, F(3, 10) = 3.708, F(10, 20) = 2.348.
TEST(FLaw, UpperTailAgreesWithTables) {
  EXPECT_NEAR(f_upper_tail(161.4476, 1, 1), 0.05, 1e-7);
  EXPECT_NEAR(f_upper_tail(3.708, 3, 10), 0.05, 2e-5);
  EXPECT_NEAR(f_upper_tail(2.348, 10, 20), 0.05, 2e-5);
  EXPECT_EQ(f_upper_tail(0, 3, 10), 1.0);
  EXPECT_EQ(f_upper_tail(std::numeric_limits<double>::infinity(), 3, 10), 0.0);
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
double normal_density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

/// P(χ'² ≤ r²) with one and three degrees of freedom: the normal law between −r and r about μ = √λ, and in
/// the ball of radius r about a centre at the distance μ.
double noncentral_cdf(int k, double r, double mu) {
  const double line = normal_cdf(r - mu) - normal_cdf(-r - mu);
  return k == 1 ? line : line - (normal_density(r - mu) - normal_density(r + mu)) / mu;
}

// Tolerance: 1e-9 up to x = 1000, and beyond what the normal law leaves of the probability there.
TEST(NoncentralChiSquare, NoncentralityAgreesWithClosedForms) {
  for (const int k : {1, 3}) {
    for (const double x : {0.9, 4.0, 30.0, 900.0, 1100.0, 1e5, 1e9}) {
      const double lambda = noncentrality(x, k, 0.05);
      EXPECT_NEAR(noncentral_cdf(k, std::sqrt(x), std::sqrt(lambda)), 0.05, x < 1000.0 ? 1e-9 : 1e-3)
          << k << " " << x;
    }
    const double lower = noncentrality(30.0, k, 0.95);
    EXPECT_NEAR(noncentral_cdf(k, std::sqrt(30.0), std::sqrt(lower)), 0.95, 1e-9);
  }
}

TEST(NoncentralChiSquare, IsZeroWhereNoneIsLikelyEnough) {
  EXPECT_EQ(noncentrality(0.5, 5.0, 0.05), 0.0);
  EXPECT_EQ(noncentrality(0.0, 1.0, 0.95), 0.0);
}

}  // namespace
}  // namespace repose::fit
