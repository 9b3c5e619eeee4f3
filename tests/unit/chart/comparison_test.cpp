#include "chart/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace repose::chart {
namespace {

/// Two sets of two runs: angles 30, 31 and 40, 41, changed by `more` everywhere.
Samples samples(double more = 0.0, double cpu = 10.0, double density = 1500.0) {
  const auto run = [&](double angle) {
    return Sample{"completed", "", angle + more, density, 2.0, cpu, "9-avx2", {}};
  };
  return {{run(30.0), run(31.0)}, {run(40.0), run(41.0)}};
}

TEST(Compare, TakesDifferencesRunByRun) {
  const Comparison rung = compare("soft", samples(0.5, 2.0, 1530.0), samples());
  ASSERT_TRUE(rung.completed);
  EXPECT_DOUBLE_EQ(rung.speed_up, 5.0);
  // The same difference in every run: the scatter of the angles does not show.
  EXPECT_NEAR(rung.angle.mean.value, 0.5, 1e-12);
  EXPECT_NEAR(rung.angle.mean.standard_error, 0.0, 1e-12);
  EXPECT_NEAR(rung.density.mean.value, 2.0, 1e-10);
  EXPECT_NEAR(rung.mass.mean.value, 0.0, 1e-12);
}

TEST(Compare, TakesTheMeanOfTheRungsRunsThatBelongToOneOfTheReference) {
  Samples more = samples(0.5, 2.0);
  for (std::vector<Sample>& set : more)  // again, in the same order, a degree higher
    for (std::size_t run = 0; run < 2; ++run) {
      set.push_back(set[run]);
      set.back().angle += 1.0, set.back().density *= 1.02;
    }
  const Comparison rung = compare("soft", more, samples());
  EXPECT_NEAR(rung.angle.mean.value, 1.0, 1e-12);
  EXPECT_NEAR(rung.angle.mean.standard_error, 0.0, 1e-12);
  EXPECT_NEAR(rung.density.mean.value, 1.0, 1e-10);
  EXPECT_EQ(rung.outcomes.at("completed"), 8);
}

TEST(Compare, ShowsWhereTheMassOnTheBaseDependsOnTheFrictions) {
  // +2 ± 0.5 % with one set, −2 ± 0.5 % with the other: nothing in the mean, all of it by set.
  Samples test = samples();
  test[0][0].mass *= 1.025, test[0][1].mass *= 1.015;
  test[1][0].mass *= 0.975, test[1][1].mass *= 0.985;
  const Comparison rung = compare("few spheres", test, samples());
  EXPECT_NEAR(rung.mass.mean.value, 0.0, 1e-10);
  EXPECT_NEAR(rung.mass.by_set[0].value, 2.0, 1e-10);
  EXPECT_NEAR(std::abs(rung.mass.worst.value), 2.0, 1e-10);
  EXPECT_TRUE(rung.mass.depends_on_friction);
  EXPECT_FALSE(rung.angle.depends_on_friction);
}

TEST(Compare, KnowsWhichRunsShareAColumn) {
  // Runs of one column are off the same way: two columns for four runs of a set leave one degree of freedom.
  const double off[] = {1.0, 1.2, -1.0, -1.2};
  const Sample run{"completed", "", 30.0, 1500.0, 2.0, 10.0, "9-avx2", {}};
  const Samples reference(2, std::vector<Sample>(4, run));
  Samples test = reference;
  for (std::vector<Sample>& set : test)
    for (std::size_t k = 0; k < 4; ++k) set[k].angle += off[k];
  const Comparison apart = compare("own columns", test, reference);
  for (std::vector<Sample>& set : test)
    for (std::size_t k = 0; k < 4; ++k) set[k].column = k / 2;
  const Comparison shared = compare("shared columns", test, reference);
  EXPECT_EQ(shared.angle.mean.value, apart.angle.mean.value);
  // One way analysis of variance: the mean of eight runs has the variance MS between columns / 8; without
  // columns it is that of all, with six degrees.
  EXPECT_NEAR(std::pow(apart.angle.mean.standard_error, 2), 2.0 * 4.88 / 6.0 / 8.0, 1e-12);
  EXPECT_NEAR(std::pow(shared.angle.mean.standard_error, 2), 8.0 * 1.21 / 8.0, 1e-12);
  EXPECT_GT(shared.angle.bound_95, apart.angle.bound_95);
  EXPECT_FALSE(apart.one_column);
  EXPECT_FALSE(shared.one_column);
  for (std::vector<Sample>& set : test)
    for (Sample& sample : set) sample.column = 3;
  EXPECT_TRUE(compare("one column", test, reference).one_column);
}

TEST(Compare, NamesTheOutcomesOfARungThatFails) {
  Samples broken = samples();
  broken[1][0].outcome = "unstable";
  broken[1][0].reason = "the step is too large";
  const Comparison rung = compare("coarse", broken, samples());
  EXPECT_FALSE(rung.completed);
  EXPECT_EQ(rung.outcomes.at("unstable"), 1);
  EXPECT_EQ(rung.outcomes.at("completed"), 3);
  EXPECT_EQ(rung.reason, "the step is too large");
}

TEST(Scatter, IsThatOfOneRunWithinItsSet) {
  // 30, 31 and 40, 41: s² = ½ in both sets; the distance of the sets does not count.
  EXPECT_NEAR(scatter_of_angle(samples()), std::sqrt(0.5), 1e-12);
}

TEST(MarkFront, KeepsWhatNothingBeatsInBoth) {
  const auto rung = [](const char* name, double error, double cpu, bool completed = true) {
    Comparison comparison = compare(name, samples(error, cpu), samples());
    comparison.completed = completed;
    return comparison;
  };
  std::vector<Comparison> rungs = {rung("a", 0.1, 8.0),
                                   rung("b", 0.5, 4.0),
                                   rung("c", 0.6, 5.0),
                                   rung("d", -0.2, 4.5),
                                   rung("fast but failed", 0.0, 1.0, false),
                                   rung("the same as b", 0.5, 4.0),  // two names of one test
                                   rung("dear", 0.0, 11.0)};
  mark_front(rungs, 10.0);
  std::string front;
  for (const Comparison& one : rungs)
    if (one.on_front) front += one.name + " ";
  EXPECT_EQ(front, "a b d the same as b ");
}

}  // namespace
}  // namespace repose::chart
