#include "sweep/plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

TEST(Plan, HasTheSceneOfEachPointAndTheKeyOfEachRun) {
  Json sweep = factorial();
  sweep["factors"]["/test/cylinder/height_mm"] = {200, 250};
  sweep["factors"]["/numerics/stiffness_scale"] = {0.5};  // a key that the case leaves to its default
  const Plan plan = make_plan(document_of(case_with(sweep)));
  ASSERT_EQ(plan.points.size(), 12U);
  ASSERT_EQ(plan.runs.size(), 24U);
  std::set<std::string> keys;
  for (const PlannedRun& run : plan.runs) {
    const PlannedPoint& point = plan.points[run.point];
    EXPECT_EQ(point.scene.contact.particle_particle.static_friction, point.values[0]);
    EXPECT_EQ(point.scene.contact.particle_particle.rolling_friction, point.values[1]);
    EXPECT_EQ(point.scene.contact.particle_particle.restitution, 0.3);
    EXPECT_NEAR(point.scene.test.cylinder_height, 1e-3 * point.values[2], 1e-15);
    EXPECT_EQ(point.scene.numerics.stiffness_scale, 0.5);
    EXPECT_EQ(run.key, run_key(point.scene, run.seed));
    keys.insert(run.key);
  }
  EXPECT_EQ(keys.size(), 24U);
  EXPECT_EQ(plan.factors_of(0), (FactorValues{{"mu_s", 0.2},
                                              {"mu_r", 0.05},
                                              {"/test/cylinder/height_mm", 200},
                                              {"/numerics/stiffness_scale", 0.5}}));
}

TEST(Plan, KeepsTheKeysOfItsRunsWhenPointsAreAdded) {
  const auto keys_of = [](const Json& sweep) {
    std::set<std::string> keys;
    for (const PlannedRun& run : make_plan(document_of(case_with(sweep))).runs) keys.insert(run.key);
    return keys;
  };
  Json larger = factorial(3);
  larger["factors"] = {{"mu_r", {0.2, 0.1, 0.05}}, {"mu_s", {0.1, 0.2, 0.5, 0.8}}};
  const auto few = keys_of(factorial(2));
  const auto many = keys_of(larger);
  EXPECT_TRUE(std::includes(many.begin(), many.end(), few.begin(), few.end()));
}

TEST(Plan, ReadsTheFactorsOfATable) {
  test::TemporaryFolder folder;
  test::write_text(folder / "points.csv",
                   "# two points\nmu_r, replicate, e_pp\n0.1, 1, 0.4\n0.1, 2, 0.4\n0.2, 1, 0.5\n");
  const Json sweep = {{"design", "table"}, {"table", "points.csv"}};
  const Plan plan = make_plan(CaseDocument::from_json(case_with(sweep), folder / "case.json"));
  ASSERT_EQ(plan.points.size(), 2U);
  ASSERT_EQ(plan.runs.size(), 3U);
  EXPECT_EQ(plan.points[1].scene.contact.particle_particle.restitution, 0.5);
  EXPECT_EQ(plan.points[1].scene.contact.particle_particle.rolling_friction, 0.2);
  EXPECT_EQ(plan.runs[1].replicate, 2);
}

TEST(Shard, PartsAreDisjointTogetherTheWholeAndEven) {
  const Plan plan = make_plan(document_of(case_with(factorial(7))));  // 42 runs
  for (const int count : {1, 2, 3, 5, 42, 50}) {
    std::multiset<std::size_t> all;
    for (int index = 1; index <= count; ++index) {
      const auto part = runs_of_shard(plan, {index, count});
      EXPECT_GE(part.size(), 42U / static_cast<unsigned>(count));
      EXPECT_LE(part.size(), 42U / static_cast<unsigned>(count) + 1U);
      all.insert(part.begin(), part.end());
    }
    EXPECT_EQ(all.size(), 42U);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), 42U);
  }
}

TEST(Shard, EachPartHasRunsOfEveryLevel) {
  const Plan plan = make_plan(document_of(case_with(factorial(10))));  // 60 runs, 20 a level of mu_s
  for (int index = 1; index <= 2; ++index) {
    std::set<double> levels;
    for (const std::size_t run : runs_of_shard(plan, {index, 2}))
      levels.insert(plan.points[plan.runs[run].point].values[0]);
    EXPECT_EQ(levels.size(), 3U);
  }
}

TEST(Shard, IsReadFromItsText) {
  const Shard shard = parse_shard("3/12");
  EXPECT_EQ(shard.index, 3);
  EXPECT_EQ(shard.count, 12);
  for (const char* bad : {"", "3", "0/4", "5/4", "-1/4", "1/0", "a/b", "1/4x", "1//4", " 1/4"})
    EXPECT_EQ(message_of([&] { parse_shard(bad); }).find("--shard"), 0U) << bad;
}

}  // namespace
}  // namespace repose::sweep
