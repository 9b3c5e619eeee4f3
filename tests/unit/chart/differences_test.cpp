#include "chart/differences.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"

namespace repose::chart {
namespace {

TEST(Judge, GivesMeansAndPooledErrorsOfSmallNumbers) {
  // Sets 1, 3 and 2, 6: means 2 and 4, squares within 2 + 8 over 2 degrees of freedom, s² = 5, n = 2.
  const Judgement judgement = judge({{1.0, 3.0}, {2.0, 6.0}});
  EXPECT_DOUBLE_EQ(judgement.by_set[0].value, 2.0);
  EXPECT_DOUBLE_EQ(judgement.by_set[1].value, 4.0);
  EXPECT_DOUBLE_EQ(judgement.by_set[0].standard_error, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(judgement.mean.value, 3.0);
  EXPECT_DOUBLE_EQ(judgement.mean.standard_error, std::sqrt(1.25));
  EXPECT_EQ(judgement.degrees_of_freedom, 2.0);
  EXPECT_EQ(judgement.worst_at, 1U);
  // Between the sets 2 (1 + 1) = 4 with 1 degree: F = 0.8; its tail with 1 and 2 degrees is P(|t₂| > √0.8)
  // = 1 − √(0.8/2.8).
  EXPECT_NEAR(judgement.dependence_p, 1.0 - std::sqrt(0.8 / 2.8), 1e-12);
  EXPECT_FALSE(judgement.depends_on_friction);
  // t(0.95, 2) = √2 · 0.9/√(1 − 0.9²) = 2.91999 (closed form of two degrees).
  EXPECT_NEAR(judgement.bound_95, 3.0 + std::sqrt(2.0) * 0.9 / std::sqrt(0.19) * std::sqrt(1.25), 1e-9);
}

TEST(Judge, TakesTheWorstSetWhereTheSetsDiffer) {
  const Judgement judgement = judge({{0.1, 0.2, 0.15}, {-2.0, -2.1, -1.9}, {0.0, 0.1, -0.1}});
  EXPECT_TRUE(judgement.depends_on_friction);
  EXPECT_EQ(judgement.worst_at, 1U);
  EXPECT_NEAR(judgement.worst.value, -2.0, 1e-12);
  EXPECT_NEAR(judgement.error.value, 2.0, 1e-12);
}

TEST(Judge, TakesOneSetAsItIs) {
  const Judgement judgement = judge({{-1.0, -1.2, -0.8}});
  EXPECT_EQ(judgement.dependence_p, 1.0);
  EXPECT_NEAR(judgement.error.value, 1.0, 1e-12);
}

TEST(Judge, SaysNothingOfNoise) {
  const Judgement judgement = judge({{0.0, 0.0}, {0.0, 0.0}});
  EXPECT_EQ(judgement.bound_95, 0.0);
  EXPECT_FALSE(judgement.depends_on_friction);
  EXPECT_EQ(judge({{1.0, 1.0}, {0.0, 0.0}}).error.value, 1.0);
}

// The bound must hold the true error in at least 95 of 100 experiments; where it depends on the frictions the
// true error is that of the worst set. 2000 experiments: 3 standard errors of 0.95 are 0.015.
TEST(Judge, BoundHoldsTheTrueErrorAsOftenAsItSays) {
  struct Truth {
    std::vector<double> sets;
    double error;
  };
  for (const Truth& truth :
       {Truth{{0.3, 0.3, 0.3}, 0.3}, Truth{{0.0, 0.0, 0.0}, 0.0}, Truth{{0.0, 0.0, 2.0}, 2.0}}) {
    RandomStream random(11, 3);
    int held = 0;
    for (int experiment = 0; experiment < 2000; ++experiment) {
      Differences differences;
      for (const double mean : truth.sets) {
        std::vector<double>& set = differences.emplace_back();
        for (int run = 0; run < 5; ++run) set.push_back(mean + 0.5 * random.normal());
      }
      held += judge(differences).bound_95 >= truth.error ? 1 : 0;
    }
    EXPECT_GE(held, 1870) << truth.error;
  }
}

}  // namespace
}  // namespace repose::chart
