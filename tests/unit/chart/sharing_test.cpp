#include "chart/sharing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chart/differences.hpp"
#include "engine/base/random.hpp"

namespace repose::chart {
namespace {

// A balanced design of one set is the one-way analysis of variance: the variance of the mean is the mean
// square between columns over the number of runs.
TEST(SharedPart, IsTheAnalysisOfVarianceOfABalancedSet) {
  const Rows rows{{1.0, 2.0, 3.0, 5.0, 6.0, 7.0}};  // columns 7 and 9, means 2 and 6 about 4
  const SharedPart part = shared_part(rows, {{7, 7, 7, 9, 9, 9}});
  const double between = 3.0 * (4.0 + 4.0), all = between + 4.0;
  EXPECT_NEAR(part.covariance(0, 0) + all / 5.0 / 6.0, between / 6.0, 1e-12);
  EXPECT_EQ(part.freedom, 1.0);
}

TEST(SharedPart, IsNothingWhereColumnsAreNoMoreAlikeThanOthers) {
  const Rows rows{{1.0, -1.0, 1.0, -1.0}};
  EXPECT_TRUE(shared_part(rows, {{0, 0, 1, 1}}).covariance.isZero(0.0));
}

TEST(SharedPart, IsNothingWhereItCannotBeTold) {
  const Rows rows{{1.0, 2.0, 4.0}, {2.0, 2.5, 3.0}};
  EXPECT_TRUE(shared_part(rows, {{3, 3, 3}, {3, 3, 3}}).covariance.isZero(0.0)) << "one column for all";
  EXPECT_TRUE(shared_part(rows, {{0, 1, 2}, {3, 4, 5}}).covariance.isZero(0.0)) << "each its own";
}

TEST(SharedPart, TakesRowsWithoutScatter) {
  const Rows rows{{2.0, 2.0, 2.0, 2.0}, {1.0, 1.1, -1.0, -1.1}};
  const Eigen::MatrixXd excess = shared_part(rows, {{0, 0, 1, 1}, {0, 0, 1, 1}}).covariance;
  EXPECT_EQ(excess(0, 0), 0.0);
  EXPECT_EQ(excess(0, 1), 0.0);
  EXPECT_GT(excess(1, 1), 0.0);
}

// Five sets of twenty runs of ten columns drawn at random, the columns with 0.4 of
// the variance of a run: what the means scatter by is what they say on the average. 4000 experiments leave
// the variance seen an error of √(2/4000) = 2.2 %, and an estimate that is cut at 0 lies some percent high:
// 10 %. The bound of the mean must hold in 95 of 100, by Satterthwaite's law in 93; without the columns it
// does not.
TEST(SharedPart, ErrorsAndBoundsOfTheMeanHold) {
  constexpr int kSets = 5, kRuns = 20, kColumns = 10, kExperiments = 4000;
  const double of_columns = std::sqrt(0.4), own = std::sqrt(0.6);
  RandomStream random(17, 1);
  double squares = 0.0, claimed = 0.0;
  int held = 0, held_without = 0;
  for (int experiment = 0; experiment < kExperiments; ++experiment) {
    std::vector<double> b;
    for (int c = 0; c < kColumns; ++c) b.push_back(of_columns * random.normal());
    Differences differences;
    Columns columns(kSets);
    for (std::size_t set = 0; set < kSets; ++set) {
      std::vector<double>& row = differences.rows.emplace_back();
      for (int run = 0; run < kRuns; ++run) {
        columns[set].push_back(static_cast<std::uint64_t>(random.uniform() * kColumns));
        row.push_back(b[columns[set].back()] + own * random.normal());
      }
    }
    const Judgement without = judge(differences);
    differences.shared = shared_part(differences.rows, columns);
    const Judgement with = judge(differences);
    squares += with.mean.value * with.mean.value;
    claimed += with.mean.standard_error * with.mean.standard_error;
    // The truth is 0: what the bound adds to |mean| must reach as far as that, on one side.
    const auto holds = [](const Judgement& one) {
      return one.mean.value + (one.mean_bound_95 - std::abs(one.mean.value)) >= 0.0;
    };
    held += holds(with) ? 1 : 0;
    held_without += holds(without) ? 1 : 0;
  }
  EXPECT_NEAR(claimed / squares, 1.0, 0.1);
  EXPECT_GE(held, static_cast<int>(0.92 * kExperiments));
  EXPECT_LE(held_without, static_cast<int>(0.86 * kExperiments));
}

TEST(SharedPart, AddsUpAndIsCompared) {
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(2, 2);
  const SharedPart none, few{unit, 2.0}, many{0.5 * unit, 9.0};
  EXPECT_EQ((few + many).covariance, 1.5 * unit);
  EXPECT_EQ((few + many).freedom, 2.0);
  EXPECT_EQ((none + many).covariance, many.covariance);
  EXPECT_EQ((many + none).freedom, 9.0);
  EXPECT_EQ(&larger(many, few), &few);
  EXPECT_EQ(&larger(few, none), &few);
  EXPECT_EQ(&larger(none, many), &many);
}

}  // namespace
}  // namespace repose::chart
