#include "chart/default_ladder.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sweep/plan.hpp"

namespace repose::chart {
namespace {

std::set<std::string> names_of(const CaseDocument& document) {
  std::set<std::string> names;
  const CaseDocument chart = with_chart(document);
  for (const auto& rung : *chart.find("/chart/rungs")) names.insert(rung.at("name").get<std::string>());
  return names;
}

TEST(DefaultLadder, IsSoundForEveryShippedCase) {
  for (const auto& entry : std::filesystem::directory_iterator("cases")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".json" || file.filename() == "case.schema.json") continue;
    if (file.filename() == "spheres_per_clump.json") continue;  // makes its clumps, which takes a minute
    const CaseDocument document = CaseDocument::load(file);
    const sweep::Plan plan = sweep::make_plan(with_chart(document));
    // A case that brings its own ladder keeps it: its rungs, the reference and the working point with each
    // set of frictions.
    const std::size_t more = document.find("/chart/working_point") != nullptr ? 2 : 1;
    if (const auto own = document.find("/chart/rungs"))
      EXPECT_EQ(plan.points.size(), document.find("/chart/frictions")->size() * (own->size() + more)) << file;
    else
      EXPECT_GE(plan.points.size(), 3U * 10U) << file;
  }
}

TEST(DefaultLadder, FollowsWhatTheCaseHas) {
  const std::set<std::string> ore = names_of(CaseDocument::load("cases/iron_ore.json"));
  for (const char* name : {"step 0.6 T_R", "stiffness × 0.01", "packing", "5 shared columns", "one shape",
                           "one size", "spheres", "grain × 2"})
    EXPECT_TRUE(ore.contains(name)) << name;
  const std::set<std::string> spheres = names_of(CaseDocument::load("cases/iron_ore_spheres.json"));
  for (const char* name : {"one shape", "one size", "spheres"}) EXPECT_FALSE(spheres.contains(name)) << name;
  CaseDocument seconds = CaseDocument::load("cases/quick.json");
  seconds.set("/numerics/time_step_s", 1e-6, "test");
  EXPECT_TRUE(names_of(seconds).contains("step × 2"));
  CaseDocument packed = CaseDocument::load("cases/quick.json");
  packed.set("/test/filling", "packing", "test");
  EXPECT_FALSE(names_of(packed).contains("rain"));
}

TEST(DefaultLadder, LeavesOutWhatDoesNotFit) {
  // Largest particle 9.85 mm: twice as large it no longer fits three times across 50 mm.
  CaseDocument narrow = CaseDocument::load("cases/quick.json");
  narrow.set("/test/cylinder/diameter_mm", 50, "test");
  EXPECT_TRUE(names_of(narrow).contains("grain × 1.5"));
  EXPECT_FALSE(names_of(narrow).contains("grain × 2"));
}

TEST(DefaultLadder, KeepsWhatACaseGives) {
  CaseDocument document = CaseDocument::load("cases/quick.json");
  const auto own = CaseDocument::Json::parse(
      R"({"rungs": [{"name": "a", "set": {"/test/filling": "rain"}}], "replicates": 7})");
  document.set("/chart", own, "test");
  const CaseDocument chart = with_chart(document);
  EXPECT_EQ(*chart.find("/chart/rungs"), own.at("rungs"));
  EXPECT_EQ(*chart.find("/chart/replicates"), 7);
  EXPECT_EQ(chart.find("/chart/frictions")->size(), 3U);
}

TEST(DefaultLadder, StandsOnTheReference) {
  CaseDocument document = CaseDocument::load("cases/quick.json");
  document.set("/chart", CaseDocument::Json::parse(R"({"reference": {"/numerics/time_step_fraction": 0.1}})"),
               "test");
  EXPECT_TRUE(names_of(document).contains("step 0.2 T_R"));
}

TEST(DefaultLadder, LetsTheWorkingPointReplaceTheReferencesStep) {
  CaseDocument document = CaseDocument::load("cases/quick.json");
  document.set("/chart", CaseDocument::Json::parse(R"({"reference": {"/numerics/time_step_s": 7e-5},
    "working_point": {"/numerics/time_step_fraction": 0.3}})"),
               "test");
  EXPECT_TRUE(names_of(document).contains("step 0.6 T_R"));
}

TEST(DefaultLadder, LeavesFaultsOfTheCaseToTheSweep) {
  CaseDocument document = CaseDocument::load("cases/quick.json");
  document.set("/particles/density_kg_m3", -1, "test");
  try {
    sweep::make_plan(with_chart(document));
    FAIL() << "the density is negative";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U) << error.what();
    EXPECT_EQ(error.faults().front().pointer, "/particles/density_kg_m3");
  }
}

TEST(DefaultLadder, StandsOnTheWorkingPoint) {
  CaseDocument document = CaseDocument::load("cases/quick.json");
  document.set("/chart", CaseDocument::Json::parse(R"({"reference": {"/numerics/time_step_fraction": 0.1},
    "working_point": {"/test/filling": "packing", "/numerics/time_step_fraction": 0.3}})"),
               "test");
  EXPECT_TRUE(names_of(document).contains("step 0.6 T_R"));
  EXPECT_FALSE(names_of(document).contains("rain"));
}

}  // namespace
}  // namespace repose::chart
