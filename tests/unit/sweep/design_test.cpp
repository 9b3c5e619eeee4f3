#include "sweep/design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "engine/base/random.hpp"

namespace repose::sweep {
namespace {

Design design_of(DesignKind kind, std::vector<std::vector<double>> levels) {
  Design design;
  design.kind = kind;
  const char* const pointers[] = {"/a", "/b", "/c", "/d"};
  for (std::size_t f = 0; f < levels.size(); ++f)
    design.factors.push_back({pointers[f], pointers[f], levels[f]});
  return design;
}

std::vector<std::vector<double>> values_of(const Design& design) {
  std::vector<std::vector<double>> values;
  for (const DesignPoint& point : points_of(design)) values.push_back(point.values);
  return values;
}

TEST(Design, FullFactorialTakesEveryCombinationTheLastFactorFastest) {
  const std::vector<std::vector<double>> expected = {{1, 4}, {1, 5}, {2, 4}, {2, 5}, {3, 4}, {3, 5}};
  EXPECT_EQ(values_of(design_of(DesignKind::full_factorial, {{1, 2, 3}, {4, 5}})), expected);
}

TEST(Design, EveryPointHasTheReplicatesAskedFor) {
  Design design = design_of(DesignKind::full_factorial, {{1, 2}});
  design.replicates = 3;
  for (const DesignPoint& point : points_of(design)) EXPECT_EQ(point.replicates, (std::vector<int>{1, 2, 3}));
}

TEST(Design, LatinHypercubeHasOnePointInEachStratumOfEachFactor) {
  for (const int n : {1, 2, 7, 60}) {
    Design design = design_of(DesignKind::latin_hypercube, {{0, 1}, {0.2, 0.8}, {-5, 5}});
    design.runs = n;
    const auto points = values_of(design);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
    for (std::size_t f = 0; f < 3; ++f) {
      const double low = design.factors[f].levels[0];
      const double high = design.factors[f].levels[1];
      std::set<int> strata;
      for (const auto& point : points) {
        EXPECT_GE(point[f], low);
        EXPECT_LT(point[f], high);
        strata.insert(static_cast<int>(std::floor((point[f] - low) / (high - low) * n)));
      }
      EXPECT_EQ(strata.size(), static_cast<std::size_t>(n));
    }
  }
}

/// The permutations of two factors are independent: the correlation of 400 points has a standard deviation of
/// 1/√399 = 0.05; five of these are allowed.
TEST(Design, LatinHypercubeShufflesItsFactorsIndependently) {
  Design design = design_of(DesignKind::latin_hypercube, {{-1, 1}, {-1, 1}});
  design.runs = 400;
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (const auto& point : values_of(design)) {
    xx += point[0] * point[0];
    yy += point[1] * point[1];
    xy += point[0] * point[1];
  }
  EXPECT_LT(std::abs(xy / std::sqrt(xx * yy)), 0.25);
}

TEST(Design, LatinHypercubeFollowsFromItsSeed) {
  Design design = design_of(DesignKind::latin_hypercube, {{0, 1}, {0, 1}});
  design.runs = 20;
  const auto first = values_of(design);
  EXPECT_EQ(values_of(design), first);
  design.seed = 2;
  EXPECT_NE(values_of(design), first);
}

/// Published points (sobol_test) within [low, high]; exact in binary.
TEST(Design, SobolPointsLieInTheRanges) {
  Design design = design_of(DesignKind::sobol, {{0, 1}, {2, 4}});
  design.runs = 4;
  const std::vector<std::vector<double>> expected = {{0, 2}, {0.5, 3}, {0.75, 2.5}, {0.25, 3.5}};
  EXPECT_EQ(values_of(design), expected);
}

TEST(Design, SobolPointsStayWhenMoreAreAdded) {
  Design design = design_of(DesignKind::sobol, {{0, 1}, {0, 1}, {0, 1}});
  design.runs = 10;
  const auto few = values_of(design);
  design.runs = 25;
  const auto many = values_of(design);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

TEST(Design, ScrambledSobolFollowsFromTheSeedAndFillsEveryStratum) {
  Design design = design_of(DesignKind::sobol, {{0, 1}, {0, 1}});
  design.runs = 64;
  const auto plain = values_of(design);
  design.scramble = true;
  const auto shifted = values_of(design);
  EXPECT_NE(shifted, plain);
  EXPECT_EQ(values_of(design), shifted);
  for (std::size_t f = 0; f < 2; ++f) {
    std::set<int> strata;
    for (const auto& point : shifted) strata.insert(static_cast<int>(64 * point[f]));
    EXPECT_EQ(strata.size(), 64U);
  }
  design.seed = 2;
  EXPECT_NE(values_of(design), shifted);
}

TEST(Design, TableGathersTheReplicatesOfAPoint) {
  Design design = design_of(DesignKind::table, {{}, {}});
  design.rows = {{{0.1, 0.2}, 1, 2}, {{0.3, 0.4}, 5, 3}, {{0.1, 0.2}, 2, 4}};
  const auto points = points_of(design);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].values, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(points[0].replicates, (std::vector<int>{1, 2}));
  EXPECT_EQ(points[1].replicates, (std::vector<int>{5}));
}

TEST(Design, TableWithoutReplicatesTakesThoseOfTheCase) {
  Design design = design_of(DesignKind::table, {{}});
  design.rows = {{{0.1}, 0, 2}};
  design.replicates = 2;
  EXPECT_EQ(points_of(design).front().replicates, (std::vector<int>{1, 2}));
}

TEST(RunSeed, DiffersBetweenPointsReplicatesAndSweeps) {
  Design design = design_of(DesignKind::full_factorial, {{}});
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t sweep : {0U, 1U, 2U}) {
    design.seed = sweep;
    for (int value = 0; value < 50; ++value)
      for (int replicate = 1; replicate <= 5; ++replicate)
        seeds.insert(seed_of(design, {0.01 * value}, replicate));
  }
  EXPECT_EQ(seeds.size(), 3U * 50U * 5U);
}

TEST(RunSeed, IsTheSameAtEveryPointWithCommonRandomNumbers) {
  Design design = design_of(DesignKind::full_factorial, {{}});
  design.common_random_numbers = true;
  EXPECT_EQ(seed_of(design, {0.1}, 1), seed_of(design, {0.9}, 1));
  EXPECT_NE(seed_of(design, {0.1}, 1), seed_of(design, {0.1}, 2));
}

TEST(RunSeed, FollowsFromTheValuesNotFromTheOrderOfTheFactors) {
  const Design one = design_of(DesignKind::full_factorial, {{}, {}});
  Design other = one;
  std::swap(other.factors[0], other.factors[1]);
  EXPECT_EQ(seed_of(one, {0.1, 0.2}, 1), seed_of(other, {0.2, 0.1}, 1));
  EXPECT_NE(seed_of(one, {0.1, 0.2}, 1), seed_of(one, {0.2, 0.1}, 1));
  EXPECT_EQ(seed_of(one, {0.0, 0.2}, 1), seed_of(one, {-0.0, 0.2}, 1));
}

/// Readers that keep numbers as doubles (JavaScript, spreadsheets) must not lose digits of a seed.
TEST(RunSeed, FitsIntoADouble) {
  const Design design = design_of(DesignKind::full_factorial, {{}});
  for (int i = 0; i < 1000; ++i) EXPECT_LT(seed_of(design, {0.001 * i}, 1), std::uint64_t{1} << 53);
}

}  // namespace
}  // namespace repose::sweep
