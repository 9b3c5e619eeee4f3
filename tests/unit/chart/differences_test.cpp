#include "chart/differences.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"

namespace repose::chart {
namespace {

// t(0.95, 2) = √2 · 0.9/√(1 − 0.9²), the closed form of two degrees of freedom.
const double kT2 = std::sqrt(2.0) * 0.9 / std::sqrt(0.19);

/// Of runs that share nothing.
Judgement judge_rows(Rows rows) { return judge({std::move(rows), {}}); }

TEST(Judge, GivesMeansAndErrorsOfSmallNumbers) {
  // Means 2 and 4, both of the variance 1 with one degree of freedom; together two degrees.
  const Judgement judgement = judge_rows({{1.0, 3.0}, {3.0, 5.0}});
  EXPECT_DOUBLE_EQ(judgement.by_set[0].value, 2.0);
  EXPECT_DOUBLE_EQ(judgement.by_set[1].value, 4.0);
  EXPECT_DOUBLE_EQ(judgement.by_set[0].standard_error, 1.0);
  EXPECT_DOUBLE_EQ(judgement.mean.value, 3.0);
  EXPECT_DOUBLE_EQ(judgement.mean.standard_error, std::sqrt(0.5));
  EXPECT_NEAR(judgement.mean_bound_95, 3.0 + kT2 * std::sqrt(0.5), 1e-12);
  EXPECT_EQ(judgement.worst_at, 1U);
  EXPECT_DOUBLE_EQ(judgement.error, std::sqrt((4.0 + 16.0) / 2.0));
  // Welch's F of two sets is the square of a t: 4/2 with two degrees, P(|t₂| > √2) = 1 − √(2/4).
  EXPECT_NEAR(judgement.dependence_p, 1.0 - std::sqrt(0.5), 1e-12);
}

TEST(Judge, TakesEachSetsOwnScatter) {
  const Judgement judgement = judge_rows({{-0.1, 0.1}, {-2.0, 2.0}});
  EXPECT_NEAR(judgement.by_set[0].standard_error, 0.1, 1e-12);
  EXPECT_NEAR(judgement.by_set[1].standard_error, 2.0, 1e-12);
  EXPECT_NEAR(judgement.mean.standard_error, std::sqrt(4.01) / 2.0, 1e-12);
}

// The bound of one set is that of a mean, |d| + t s/√n, where that is far from 0: 23 times its variance here,
// so that the other tail is below 1e-20.
TEST(Judge, BoundsOneSetAsAMean) {
  const Judgement judgement = judge_rows({{-1.0, -1.2, -0.8}});
  EXPECT_EQ(judgement.dependence_p, 1.0);
  EXPECT_NEAR(judgement.bound_95, 1.0 + kT2 * 0.2 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(judgement.low_95, 1.0 - kT2 * 0.2 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(judgement.mean_bound_95, judgement.bound_95, 1e-9);
}

TEST(Judge, ErrorIsNotHiddenByTheMean) {
  const Judgement judgement = judge_rows({{0.9, 1.0, 1.1}, {-1.1, -1.0, -0.9}, {0.0, 0.1, -0.1}});
  EXPECT_NEAR(judgement.mean.value, 0.0, 1e-12);
  EXPECT_TRUE(judgement.depends_on_friction);
  EXPECT_NEAR(judgement.error, std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_GT(judgement.low_95, 0.7);
  EXPECT_LT(judgement.bound_95, 0.95);
}

// Ten plants each of Dobson's (1983) weights of plants under control and two treatments: Welch's F = 5.181
// with 2 and 17.128 degrees, p = 0.01739. Tolerance: the last digit.
TEST(Judge, TellsSetsOfOwnScatterApartAsWelchDoes) {
  const Judgement judgement = judge_rows({{4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14},
                                          {4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69},
                                          {6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26}});
  EXPECT_NEAR(judgement.dependence_p, 0.01739, 5e-6);
}

TEST(Judge, SaysNothingOfNoise) {
  const Judgement same = judge_rows({{0.0, 0.0}, {0.0, 0.0}});
  EXPECT_EQ(same.bound_95, 0.0);
  EXPECT_EQ(same.mean_bound_95, 0.0);
  EXPECT_FALSE(same.depends_on_friction);
  const Judgement sure = judge_rows({{1.0, 1.0}, {0.0, 0.0}});
  EXPECT_EQ(sure.error, std::sqrt(0.5));
  EXPECT_EQ(sure.bound_95, sure.error);
  EXPECT_TRUE(sure.depends_on_friction);
}

// Differences that cancel by luck are no proof: the bound stays above the noise of a set.
TEST(Judge, BoundIsNotBelowTheNoise) {
  const Judgement judgement = judge_rows({{-1.0, 1.0, 0.0}, {1.0, 0.0, -1.0}, {0.0, -1.0, 1.0}});
  EXPECT_EQ(judgement.error, 0.0);
  EXPECT_EQ(judgement.low_95, 0.0);
  EXPECT_GT(judgement.bound_95, 1.0 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(judgement.noise_bound_95, judgement.bound_95);
}

// Every run twice: Σ squares/(n (n − 1)) is Q/12 with four and 2 Q/56 with eight, 3/7 of it, and there are
// more degrees of freedom.
TEST(Judge, NoiseBoundFallsWithTheReplicates) {
  const Judgement few = judge_rows({{-1.0, 1.0, 0.0, 3.0}, {1.0, 2.0, -1.0, 0.5}});
  const Judgement many =
      judge_rows({{-1.0, 1.0, 0.0, 3.0, -1.0, 1.0, 0.0, 3.0}, {1.0, 2.0, -1.0, 0.5, 1.0, 2.0, -1.0, 0.5}});
  EXPECT_LT(many.noise_bound_95, few.noise_bound_95 * std::sqrt(3.0 / 7.0));
  EXPECT_GT(many.noise_bound_95, 0.8 * few.noise_bound_95 * std::sqrt(3.0 / 7.0));
}

// The bounds must hold the true error in some 95 of 100 experiments. χ'² is an approximation where sets
// scatter differently: 93 and more. 2000 experiments: 3 standard errors of 0.93 are 0.017.
TEST(Judge, BoundsHoldTheTrueErrorAsOftenAsTheySay) {
  struct Truth {
    std::vector<double> means, scatter;
    int runs = 5;
  };
  const std::vector<double> alike{0.5, 0.5, 0.5}, unlike{0.3, 0.3, 1.0};
  Truth loud{std::vector<double>(9, 0.8), std::vector<double>(9, 0.05), 20};  // all but one are known well
  loud.means.back() = 1.0, loud.scatter.back() = 2.0;
  Truth signs{{0.5, -0.5, 0.5, -0.5, 0.5, -0.5, 0.5, -0.5, 1.5}, std::vector<double>(9, 0.3)};
  signs.scatter.back() = 1.5;
  for (const Truth& truth :
       {Truth{{0.3, 0.3, 0.3}, alike}, Truth{{0.0, 0.0, 0.0}, alike}, Truth{{0.0, 0.0, 2.0}, alike},
        Truth{{0.0, 0.0, 2.0}, unlike}, Truth{{2.0, 0.0, 0.0}, unlike}, Truth{{0.5, -0.5, 0.5}, unlike},
        Truth{{1.0, 1.0, 1.0, 1.0, 1.0}, {0.05, 0.05, 0.05, 0.05, 2.0}, 10},
        Truth{{1.0, 1.0, 1.0, 1.0, 1.0}, {1.1, 1.1, 1.5, 2.0, 3.3}, 20}, loud, signs}) {
    double squares = 0.0;
    for (const double mean : truth.means) squares += mean * mean / static_cast<double>(truth.means.size());
    RandomStream random(11, 3);
    int above = 0, below = 0;
    for (int experiment = 0; experiment < 2000; ++experiment) {
      Differences differences;
      for (std::size_t set = 0; set < truth.means.size(); ++set) {
        std::vector<double>& row = differences.rows.emplace_back();
        for (int run = 0; run < truth.runs; ++run)
          row.push_back(truth.means[set] + truth.scatter[set] * random.normal());
      }
      const Judgement judgement = judge(differences);
      above += judgement.bound_95 >= std::sqrt(squares) ? 1 : 0;
      below += judgement.low_95 <= std::sqrt(squares) ? 1 : 0;
    }
    EXPECT_GE(above, 1826) << truth.means.size() << " sets, the last " << truth.means.back() << " ± "
                           << truth.scatter.back();
    EXPECT_GE(below, 1826) << truth.means.size() << " sets, the last " << truth.means.back() << " ± "
                           << truth.scatter.back();
  }
}

}  // namespace
}  // namespace repose::chart
