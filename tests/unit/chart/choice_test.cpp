#include "chart/choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "engine/base/random.hpp"

namespace repose::chart {
namespace {

/// A rung that shifts the angle by `error`, with noise of its own and the noise of a reference that all
/// share.
Candidate candidate(const std::string& name, std::vector<std::string> pointers, double error,
                    double cost_ratio, double noise = 0.0, std::uint64_t stream = 0,
                    std::uint64_t reference = 0) {
  Candidate rung{name, std::move(pointers), {}, cost_ratio};
  RandomStream own(5, stream), shared(6, reference);
  for (int set = 0; set < 3; ++set) {
    std::vector<double>& row = rung.angle.rows.emplace_back();
    for (int run = 0; run < 8; ++run) row.push_back(error + noise * own.normal() - noise * shared.normal());
  }
  return rung;
}

std::vector<Candidate> ladder() {
  return {candidate("step 2", {"/numerics/time_step_fraction"}, 0.05, 0.5),
          candidate("step 3", {"/numerics/time_step_fraction"}, 0.3, 0.33),
          candidate("soft", {"/numerics/stiffness_scale"}, 0.2, 0.1),
          candidate("rain", {"/test/filling"}, -0.1, 0.8),
          candidate("8 spheres", {"/particles/shapes/0/spheres", "/particles/shapes/1/spheres"}, 1.5, 0.3),
          candidate("spheres", {"/particles/shapes"}, -9.0, 0.05)};
}

TEST(Exclude, IsTheSamePointerOrOneBelowIt) {
  const auto rungs = ladder();
  EXPECT_TRUE(exclude_each_other(rungs[0], rungs[1]));
  EXPECT_TRUE(exclude_each_other(rungs[4], rungs[5]));
  EXPECT_FALSE(exclude_each_other(rungs[0], rungs[2]));
  EXPECT_TRUE(exclude_each_other(rungs[0], candidate("step in s", {"/numerics/time_step_s"}, 0, 1)))
      << "a case gives one of the two";
  EXPECT_FALSE(exclude_each_other(candidate("a", {"/numerics/time"}, 0, 1), rungs[0]));
}

TEST(CombinationsWithin, AreCheapestFirstAndWithinTheLimit) {
  const auto rungs = ladder();
  const auto found = combinations_within(0.5, rungs);
  ASSERT_FALSE(found.empty());
  // 0.3 + 0.2 − 0.1 = 0.4: of all sums below 0.5 the one with the smallest product of costs.
  EXPECT_EQ(name_of(found.front(), rungs), "step 3 + soft + rain");
  EXPECT_NEAR(found.front().cost_ratio, 0.33 * 0.1 * 0.8, 1e-12);
  EXPECT_NEAR(found.front().predicted.error, 0.4, 1e-12);
  for (std::size_t k = 1; k < found.size(); ++k) EXPECT_GE(found[k].cost_ratio, found[k - 1].cost_ratio);
}

TEST(CombinationsWithin, AreAllThatThereAre) {
  // Every subset of the six rungs, looked at one by one.
  const auto rungs = ladder();
  std::map<std::string, double> expected;
  for (unsigned subset = 1; subset < 64; ++subset) {
    Combination combination;
    double sum = 0.0;
    bool allowed = true;
    for (std::size_t k = 0; k < rungs.size(); ++k) {
      if (!(subset >> k & 1U)) continue;
      for (const std::size_t other : combination.rungs)
        allowed = allowed && !exclude_each_other(rungs[k], rungs[other]);
      combination.rungs.push_back(k);
      sum += rungs[k].angle.rows[0][0];
    }
    if (allowed && std::abs(sum) < 0.5) expected[name_of(combination, rungs)] = std::abs(sum);
  }
  std::map<std::string, double> found;
  for (const Combination& combination : combinations_within(0.5, rungs))
    found[name_of(combination, rungs)] = combination.predicted.error;
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, error] : expected) EXPECT_NEAR(found.at(name), error, 1e-12) << name;
}

TEST(CombinationsWithin, CountTheNoiseOfTheReferenceAsOftenAsItOccurs) {
  // Differences a − r and b − r: their sum has the variance σ² (1 + 1 + 4), not that of two independent
  // differences, σ² (2 + 2). Over 200 ladders of 24 values, 21 degrees of freedom each, the mean square is
  // known to √(2/4200) = 2.2 %: within four of these, where the other would be 33 % off.
  constexpr int kLadders = 200;
  double squares = 0.0;
  for (std::uint64_t ladder = 0; ladder < kLadders; ++ladder) {
    const auto one = [&](const char* name, const char* pointer, std::uint64_t own) {
      return candidate(name, {pointer}, 0.0, 0.5, 0.1, 2 * ladder + own, ladder);
    };
    const std::vector<Candidate> rungs = {one("a", "/test/filling", 0),
                                          one("b", "/numerics/stiffness_scale", 1)};
    const auto found = combinations_within(10.0, rungs);
    ASSERT_EQ(name_of(found.front(), rungs), "a + b");
    squares += std::pow(found.front().predicted.mean.standard_error, 2) / kLadders;
  }
  EXPECT_NEAR(squares, 0.01 * 6.0 / 24.0, 0.09 * 0.01 * 6.0 / 24.0);
}

TEST(CombinationsWithin, StandOnTheWorkingPoint) {
  // The working point is 0.3 off at a tenth of the cost. On it "soft" adds 0.25 − 0.3 and halves the cost,
  // and "rain" adds −0.2 − 0.3: together 0.3 − 0.05 − 0.5 = −0.25 at 0.1 · 0.5 · 0.8.
  const Candidate working_point = candidate("working point", {}, 0.3, 0.1);
  const std::vector<Candidate> rungs = {candidate("soft", {"/numerics/stiffness_scale"}, 0.25, 0.05),
                                        candidate("rain", {"/test/filling"}, -0.2, 0.08)};
  const auto found = combinations_within(0.5, rungs, working_point);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(name_of(found[0], rungs), "soft + rain");
  EXPECT_NEAR(found[0].cost_ratio, 0.04, 1e-12);
  EXPECT_NEAR(found[0].predicted.mean.value, -0.25, 1e-12);
  EXPECT_EQ(name_of(found[3], rungs), "working point");
  EXPECT_NEAR(found[3].predicted.mean.value, 0.3, 1e-12);
  const auto alone = combinations_within(0.5, {}, working_point);
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_TRUE(alone.front().rungs.empty());
}

TEST(CombinationsWithin, AreCheaperThanTheReference) {
  const std::vector<Candidate> rungs = {candidate("soft", {"/numerics/stiffness_scale"}, 0.1, 0.5)};
  const auto found = combinations_within(0.5, rungs, candidate("working point", {}, 0.1, 1.05));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(name_of(found[0], rungs), "soft");
}

TEST(CombinationsWithin, CountTheNoiseOfTheWorkingPointAsOftenAsItOccurs) {
  // a − w and b − w on w − r: (a − w) + (b − w) + (w − r) = a + b − w − r, of variance 4 σ². 21 degrees of
  // freedom: 40 % are about two and a half standard errors of s.
  const std::vector<Candidate> rungs = {candidate("a", {"/test/filling"}, 0.0, 0.5, 0.1, 1),
                                        candidate("b", {"/numerics/stiffness_scale"}, 0.0, 0.5, 0.1, 2)};
  const auto found = combinations_within(10.0, rungs, candidate("working point", {}, 0.0, 0.8, 0.1, 3));
  EXPECT_EQ(name_of(found.front(), rungs), "a + b");
  EXPECT_NEAR(found.front().predicted.mean.standard_error, 0.1 * std::sqrt(4.0 / 24.0),
              0.4 * 0.1 * std::sqrt(4.0 / 24.0));
}

TEST(CombinationsWithin, AreNoneWhereTheNoiseIsLarger) {
  const std::vector<Candidate> rungs = {candidate("a", {"/test/filling"}, 0.0, 0.5, 3.0, 1)};
  EXPECT_TRUE(combinations_within(0.5, rungs).empty());
}

TEST(CombinationsWithin, RefuseALadderThatIsTooLong) {
  std::vector<Candidate> rungs;
  for (int k = 0; k < 22; ++k) rungs.push_back(candidate("r", {"/numerics/" + std::to_string(k)}, 99.0, 0.5));
  EXPECT_THROW(combinations_within(0.5, rungs), std::length_error);
}

TEST(NextAfter, IsNoticeablyDearer) {
  const std::vector<Combination> list = {{{0}, 0.10, {}}, {{1}, 0.11, {}}, {{2}, 0.12, {}}, {{3}, 0.3, {}}};
  EXPECT_EQ(next_after(list, 0.10), 2U);
  EXPECT_EQ(next_after(list, 0.12), 3U);
  EXPECT_EQ(next_after(list, 0.3), 4U);
}

}  // namespace
}  // namespace repose::chart
