#include "engine/measure/residual_density.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"

namespace repose {
namespace {

/// −f′/(f + floor) by the sum over all residuals; the floor is 2 % of the peak, searched on a fine grid.
double direct_score(const std::vector<double>& residuals, double h, double x) {
  const auto density = [&](double at) {
    double sum = 0.0;
    for (const double e : residuals) sum += std::exp(-0.5 * (at - e) * (at - e) / (h * h));
    return sum;
  };
  double peak = 0.0;
  for (double at = -2.0; at < 2.0; at += 0.002) peak = std::max(peak, density(at));
  const double step = 1e-5 * h;
  return -(density(x + step) - density(x - step)) / (2.0 * step) / (density(x) + 0.02 * peak);
}

TEST(ResidualDensity, ScoreIsThatOfTheKernelDensity) {
  RandomStream random(5, 0);
  std::vector<double> residuals(200);
  for (double& e : residuals) e = random.normal() * 0.3;
  const double h = 0.15;
  const ResidualDensity density(residuals, std::vector<double>(residuals.size(), 1.0), h);
  // The table has four nodes per bandwidth and is read linearly: about (1/4)²/8 of the score's own scale 1/h.
  for (double x = -0.8; x <= 0.8; x += 0.05) {
    EXPECT_NEAR(density.score(x) * h, direct_score(residuals, h, x) * h, 0.02) << "at " << x;
  }
}

TEST(ResidualDensity, SharesWeightsLikeRepeatedTops) {
  const std::vector<double> repeated{0.0, 0.0, 0.0, 1.0};
  const std::vector<double> distinct{0.0, 1.0, 5.0};
  const ResidualDensity a(repeated, {1.0, 1.0, 1.0, 1.0}, 0.5);
  const ResidualDensity b(distinct, {3.0, 1.0, 0.0}, 0.5);
  for (double x = -1.0; x <= 2.0; x += 0.25) EXPECT_NEAR(a.score(x), b.score(x), 1e-12);
}

TEST(ResidualDensity, GivesATopFarFromAllOthersNoInfluence) {
  std::vector<double> residuals(300, 0.0);
  RandomStream random(9, 0);
  for (double& e : residuals) e = random.uniform(-0.1, 0.1);
  residuals.push_back(3.0);
  const ResidualDensity density(residuals, std::vector<double>(residuals.size(), 1.0), 0.05);
  // A Gaussian's score one bandwidth off its middle is 1/h; here the top's own place between nodes is left.
  EXPECT_NEAR(density.score(3.0), 0.0, 1e-4 / 0.05);
}

}  // namespace
}  // namespace repose
