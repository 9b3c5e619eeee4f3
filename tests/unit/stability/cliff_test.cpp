#include "engine/stability/cliff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace repose::test {
namespace {

/// An experiment that is stable up to a step, and remembers what it was asked.
struct KnownCliff {
  double at = 1.0;
  std::vector<double> asked{};

  Experiment experiment() {
    return [this](double step) {
      asked.push_back(step);
      Probe probe;
      probe.step = step;
      probe.energy_error = step / at;
      if (step > at) probe.failure = Failure::energy;
      return probe;
    };
  }
};

TEST(Cliff, IsBracketedToThePrecisionFromBelowAndFromAbove) {
  for (const double start : {0.01, 0.9, 1.0, 1.1, 30.0})
    for (const double precision : {0.2, 0.05, 0.01}) {
      KnownCliff known;
      const Cliff cliff = find_cliff(known.experiment(), {start, precision});
      EXPECT_LE(cliff.stable, known.at) << start;
      EXPECT_GT(cliff.unstable, known.at) << start;
      EXPECT_LE(cliff.unstable, (1.0 + precision) * cliff.stable) << start;
      EXPECT_EQ(cliff.failure, Failure::energy);
      ASSERT_NE(cliff.last_stable(), nullptr);
      EXPECT_EQ(cliff.last_stable()->step, cliff.stable);
    }
}

TEST(Cliff, ItsProbesAscendAndShowBothSides) {
  KnownCliff known;
  const Cliff cliff = find_cliff(known.experiment(), {0.95, 0.05});
  for (std::size_t k = 1; k < cliff.probes.size(); ++k)
    EXPECT_GT(cliff.probes[k].step, cliff.probes[k - 1].step);
  EXPECT_LT(cliff.probes.front().step, 0.4 * known.at);
  EXPECT_GT(cliff.probes.back().step, 1.9 * known.at);
}

TEST(Cliff, WhereNoStepIsStableThereIsNone) {
  const Cliff cliff = find_cliff(
      [](double step) {
        Probe probe;
        probe.step = step;
        probe.failure = Failure::diverged;
        return probe;
      },
      {1.0, 0.05});
  EXPECT_EQ(cliff.stable, 0.0);
  EXPECT_EQ(cliff.last_stable(), nullptr);
  EXPECT_EQ(cliff.probes.size(), static_cast<std::size_t>(kLongestWalkDown) + 1);
  EXPECT_NEAR(cliff.probes.front().step, std::pow(kWalk, -kLongestWalkDown), 1e-12);
}

TEST(Cliff, WhereEveryStepIsStableThereIsNone) {
  KnownCliff known{1e300};
  const Cliff cliff = find_cliff(known.experiment(), {1.0, 0.05});
  EXPECT_EQ(cliff.unstable, 0.0);
  EXPECT_EQ(cliff.failure, Failure::none);
  EXPECT_GT(cliff.stable, 1.0);
}

// Unstable between 1 and 3, stable again beyond: the lower cliff is the one that counts.
TEST(Cliff, TheLowestOfSeveralIsFound) {
  const Cliff cliff = find_cliff(
      [](double step) {
        Probe probe;
        probe.step = step;
        if (step > 1.0 && step < 3.0) probe.failure = Failure::overlap;
        return probe;
      },
      {0.1, 0.05});
  EXPECT_LE(cliff.stable, 1.0);
  EXPECT_GT(cliff.stable, 1.0 / 1.05);
}

TEST(Cliff, AnInterruptedProbeEndsTheSearchAndCountsForNothing) {
  int asked = 0;
  const Cliff cliff = find_cliff(
      [&asked](double step) {
        Probe probe;
        probe.step = step;
        if (++asked == 3) probe.failure = Failure::interrupted;
        return probe;
      },
      {1.0, 0.05});
  EXPECT_TRUE(cliff.interrupted);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(cliff.probes.size(), 2U);
  EXPECT_EQ(cliff.unstable, 0.0);
}

}  // namespace
}  // namespace repose::test
