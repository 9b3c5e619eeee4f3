#include "sweep/ladder.hpp"

#include <algorithm>
#include <set>

#include "engine/base/json_file.hpp"
#include "engine/shape/clump.hpp"
#include "sweep/plan.hpp"
#include "sweep/study.hpp"
#include "unit/sweep/sweep_fixture.hpp"

namespace repose::sweep {
namespace {

Json charted(const Json& chart) {
  Json json = case_with({{"design", "chart"}});
  json["chart"] = chart;
  return json;
}

Json small_chart() {
  return Json::parse(R"({
    "reference": {"/numerics/time_step_fraction": 0.1},
    "rungs": [{"name": "long step", "set": {"/numerics/time_step_fraction": 0.4}},
              {"name": "soft rain", "set": {"/numerics/stiffness_scale": 0.1, "/test/filling": "rain"}}],
    "frictions": [{"mu_s": 0.3, "mu_r": 0.1}, {"mu_r": 0.2, "mu_s": 0.6}, {"mu_s": 0.8, "mu_r": 0.2}],
    "replicates": 2, "seed": 9})");
}

TEST(ChartDesign, HoldsReferenceAndRungsWithEverySetOfFrictions) {
  const Plan plan = make_plan(document_of(charted(small_chart())));
  ASSERT_EQ(plan.points.size(), 9U);
  ASSERT_EQ(plan.runs.size(), 18U);
  EXPECT_EQ(plan.variant_of(0), "reference");
  EXPECT_EQ(plan.variant_of(3), "long step");
  EXPECT_EQ(plan.variant_of(8), "soft rain");
  EXPECT_EQ(plan.points[0].scene.numerics.time_step_fraction, 0.1);
  EXPECT_EQ(plan.points[3].scene.numerics.time_step_fraction, 0.4);
  EXPECT_EQ(plan.points[6].scene.numerics.time_step_fraction, 0.1) << "a rung stands on the reference";
  EXPECT_EQ(plan.points[6].scene.test.filling, Filling::rain);
  EXPECT_EQ(plan.points[7].scene.contact.particle_particle.static_friction, 0.6);
  EXPECT_EQ(plan.points[7].scene.contact.particle_particle.rolling_friction, 0.2);
}

TEST(ChartDesign, SharesSeedsBetweenRungsOnly) {
  const Plan plan = make_plan(document_of(charted(small_chart())));
  std::set<std::uint64_t> seeds;
  for (const PlannedRun& run : plan.runs) {
    seeds.insert(run.seed);
    const std::size_t same = run.point % 3;
    EXPECT_EQ(run.seed, plan.runs[2 * same + static_cast<std::size_t>(run.replicate) - 1].seed);
  }
  EXPECT_EQ(seeds.size(), 6U);  // three sets, two replicates
}

TEST(ChartDesign, LongerLadderKeepsTheRunsThatThereAre) {
  Json longer = small_chart();
  const Json more = {{"name", "first"}, {"set", {{"/test/opening_speed_m_s", 2.0}}}};
  longer["rungs"].insert(longer["rungs"].begin(), more);
  std::set<std::string> before, after;
  for (const PlannedRun& run : make_plan(document_of(charted(small_chart()))).runs) before.insert(run.key);
  for (const PlannedRun& run : make_plan(document_of(charted(longer))).runs) after.insert(run.key);
  EXPECT_EQ(before.size() + 6, after.size());
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
}

TEST(ChartDesign, RunsRungsMoreOftenThanTheReferenceWhereAskedTo) {
  Json more = small_chart();
  more["rung_replicates"] = 6;
  std::set<std::string> before, after;
  for (const PlannedRun& run : make_plan(document_of(charted(small_chart()))).runs) before.insert(run.key);
  const Plan plan = make_plan(document_of(charted(more)));
  for (const PlannedRun& run : plan.runs) after.insert(run.key);
  const auto runs_of = [&](std::size_t point) {
    return std::ranges::count(plan.runs, point, &PlannedRun::point);
  };
  EXPECT_EQ(runs_of(0), 2);
  EXPECT_EQ(runs_of(3), 6);
  EXPECT_EQ(after.size(), 6U + 2U * 18U);
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  more["rung_replicates"] = 5;
  EXPECT_NE(message_of([&] {
              make_plan(document_of(charted(more)));
            }).find("case.json: /chart/rung_replicates = 5: must be a multiple of replicates, 2"),
            std::string::npos);
}

TEST(ChartDesign, RungsStandOnTheWorkingPointThatIsTheFirst) {
  Json chart = small_chart();
  chart["working_point"] = {{"/test/filling", "packing"}, {"/particles/total_mass_kg", 0.01}};
  const Plan plan = make_plan(document_of(charted(chart)));
  ASSERT_EQ(plan.points.size(), 12U);
  EXPECT_EQ(plan.variant_of(0), "reference");
  EXPECT_EQ(plan.points[0].scene.particles.total_mass,
            make_plan(document_of(charted(small_chart()))).points[0].scene.particles.total_mass);
  EXPECT_EQ(plan.variant_of(3), "working point");
  EXPECT_EQ(plan.points[3].scene.test.filling, Filling::packing);
  EXPECT_EQ(plan.points[3].scene.numerics.time_step_fraction, 0.1) << "it stands on the reference";
  EXPECT_EQ(plan.points[6].scene.particles.total_mass, 0.01);
  EXPECT_EQ(plan.points[6].scene.numerics.time_step_fraction, 0.4);
  EXPECT_EQ(plan.points[9].scene.test.filling, Filling::rain) << "a rung replaces what it sets";
  EXPECT_EQ(plan.points[9].scene.particles.total_mass, 0.01);
}

/// The same runs whether shared settings are written once or with every rung.
TEST(ChartDesign, WorkingPointIsShorthand) {
  Json once = small_chart(), often = small_chart();
  const Json shared = {{"/test/filling", "packing"}, {"/particles/shapes/0/diameter_mm", 7}};
  once["working_point"] = shared;
  once["rungs"].push_back(
      {{"name", "large"}, {"set", {{"/particles/shapes", {{{"sphere", true}, {"diameter_mm", 9}}}}}}});
  often["rungs"][0]["set"].update(shared);
  often["rungs"][1]["set"]["/particles/shapes/0/diameter_mm"] = 7;
  often["rungs"].push_back(
      {{"name", "large"},
       {"set",
        {{"/particles/shapes", {{{"sphere", true}, {"diameter_mm", 9}}}}, {"/test/filling", "packing"}}}});
  often["rungs"].push_back({{"name", "shared"}, {"set", shared}});
  const auto keys = [](const Json& chart) {
    std::set<std::string> keys;
    for (const PlannedRun& run : make_plan(document_of(charted(chart))).runs) keys.insert(run.key);
    return keys;
  };
  EXPECT_EQ(keys(once), keys(often));
}

TEST(ChartDesign, OneSetGivesOneOfTwoKeysThatExcludeEachOther) {
  Json chart = small_chart();
  chart["working_point"] = {{"/numerics/time_step_s", 1e-5}, {"/numerics/time_step_fraction", 0.1}};
  const std::string message = message_of([&] { make_plan(document_of(charted(chart))); });
  EXPECT_NE(message.find("/chart/working_point/~1numerics~1time_step"), std::string::npos) << message;
  EXPECT_NE(message.find("excludes /numerics/time_step"), std::string::npos) << message;
  // What a rung gives takes the place of the other that it stands on.
  chart["working_point"] = {{"/numerics/time_step_s", 1e-5}};
  const Plan plan = make_plan(document_of(charted(chart)));
  EXPECT_EQ(plan.points[3].scene.numerics.time_step, 1e-5);
  EXPECT_EQ(plan.points[6].scene.numerics.time_step_fraction, 0.4);
  EXPECT_FALSE(plan.points[6].scene.numerics.time_step);
  EXPECT_EQ(plan.design.ladder.rungs[1].set.size(), 1U);
}

TEST(ChartDesign, NamesEveryFaultOfFrictionsAndRungsTogether) {
  Json chart = small_chart();
  chart["frictions"] =
      Json::parse(R"([{"mu_s": -1, "mu_r": 0.1}, {"mu_s": -2, "mu_r": 0.2}, {"mu_s": 0.3, "mu_r": -7}])");
  chart["working_point"] = {{"/numerics/stiffness_scale", -1}};
  chart["rungs"][1]["set"] = {{"/contact/rolling_model", 7}};
  chart["replicates"] = 1;
  const std::string message = message_of([&] { make_plan(document_of(charted(chart))); });
  for (const char* fault :
       {"/chart/frictions/0/mu_s = -1", "/chart/frictions/1/mu_s = -2", "/chart/frictions/2/mu_r = -7",
        "/chart/working_point/~1numerics~1stiffness_scale = -1",
        "/chart/rungs/1/set/~1contact~1rolling_model = 7", "/chart/replicates = 1"})
    EXPECT_NE(message.find(fault), std::string::npos) << fault << "\nin\n" << message;
}

TEST(ChartDesign, NamesFaultsOfTheWorkingPointOnce) {
  Json chart = small_chart();
  chart["working_point"] = {{"/numerics/stiffness_scale", -1}, {"/numerics/time_stop", 1}};
  chart["rungs"][0]["name"] = "working point";
  chart["rungs"][1]["set"].erase("/numerics/stiffness_scale");
  const std::string message = message_of([&] { make_plan(document_of(charted(chart))); });
  EXPECT_NE(message.find("/chart/working_point/~1numerics~1time_stop = 1: is not known"), std::string::npos)
      << message;
  EXPECT_NE(message.find("/chart/rungs/0/name = \"working point\": is the name of what rungs stand on"),
            std::string::npos)
      << message;
  chart["working_point"].erase("/numerics/time_stop");
  chart["rungs"][0]["name"] = "long step";
  const std::string value = message_of([&] { make_plan(document_of(charted(chart))); });
  const std::string fault = "/chart/working_point/~1numerics~1stiffness_scale = -1: must be";
  ASSERT_NE(value.find(fault), std::string::npos) << value;
  EXPECT_EQ(value.find(fault, value.find(fault) + 1), std::string::npos) << value;
  chart["working_point"] = Json::object();
  EXPECT_NE(message_of([&] {
              make_plan(document_of(charted(chart)));
            }).find("/chart/working_point = {}: must be an object with at least one"),
            std::string::npos);
}

TEST(ChartDesign, NamesEveryFaultAtItsPlace) {
  Json chart = small_chart();
  chart["rung"] = 1;
  chart["replicates"] = 1;
  chart["reference"]["/sweep/seed"] = 3;
  chart["rungs"][0]["set"]["/numerics/time_stop"] = 1;
  chart["rungs"][1]["name"] = "long step";
  chart["rungs"].push_back({{"name", ""}, {"set", Json::object()}});
  chart["frictions"][1] = {{"mu_s", 0.1}};
  chart["frictions"][2] = chart["frictions"][0];
  const std::string message = message_of([&] { make_plan(document_of(charted(chart))); });
  for (const char* fault :
       {"case.json: /chart/rung = 1: is not known here; did you mean \"rungs\"?",
        "case.json: /chart/replicates = 1: must be an integer from 2 to 10000",
        "case.json: /chart/reference/~1sweep~1seed = 3: cannot be set by a ladder",
        "case.json: /chart/rungs/0/set/~1numerics~1time_stop = 1: is not known",
        "case.json: /chart/rungs/1/name = \"long step\": stands in this ladder twice",
        "case.json: /chart/rungs/2/name = \"\": must be a text that is not empty",
        "case.json: /chart/rungs/2/set = {}: must be an object with at least one",
        "case.json: /chart/frictions/1 = {\"mu_s\":0.1}: must give the factors of the first set: mu_r, mu_s",
        "case.json: /chart/frictions/2 = {\"mu_s\":0.3,\"mu_r\":0.1}: stands in this list twice"})
    EXPECT_NE(message.find(fault), std::string::npos) << fault << "\nin\n" << message;
}

TEST(ChartDesign, NamesWhatTheSceneRefusesAtItsRung) {
  Json chart = small_chart();
  chart["rungs"][0]["set"]["/numerics/time_step_fraction"] = -1;
  chart["rungs"][1]["set"]["/particles/shapes"] = {{{"sphere", true}, {"diameter_mm", -8}}};
  const std::string message = message_of([&] { make_plan(document_of(charted(chart))); });
  for (const char* fault :
       {"case.json: /chart/rungs/0/set/~1numerics~1time_step_fraction = -1: must be > 0",
        "case.json: /chart/rungs/1/set/~1particles~1shapes/0/diameter_mm = -8: must be > 0"})
    EXPECT_NE(message.find(fault), std::string::npos) << fault << "\nin\n" << message;
}

TEST(ChartDesign, TakesNothingBesideItsName) {
  Json json = charted(small_chart());
  json["sweep"]["replicates"] = 3;
  EXPECT_NE(message_of([&] {
              make_plan(document_of(json));
            }).find("/sweep/replicates = 3: does not belong to a design of this kind"),
            std::string::npos);
  json = case_with({{"design", "chart"}});
  EXPECT_NE(message_of([&] { make_plan(document_of(json)); }).find("/chart: is missing"), std::string::npos);
}

TEST(ChartStudy, TakesTheFilesOfItsRungsWithItAndStoresTheirNames) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "shapes");
  write_clump(folder / "shapes/ball.json", sphere_clump(0.0045));
  Json chart = small_chart();
  chart["rungs"][0] = {{"name", "ball"}, {"set", {{"/particles/shapes", {{{"clump", "shapes/ball.json"}}}}}}};
  const Json json = charted(chart);
  test::write_text(folder / "case.json", json.dump());
  const CaseDocument document = CaseDocument::load(folder / "case.json");
  const SweepSummary first = run_sweep(document, folder / "study", with_fake_run());
  EXPECT_EQ(first.finished, 18);
  std::filesystem::remove_all(folder / "shapes");
  std::filesystem::rename(folder / "study", folder / "moved");
  const StudyStatus status = status_of(folder / "moved");
  EXPECT_EQ(status.planned, 18);
  EXPECT_EQ(status.left, 0);
  std::map<std::string, int> variants;
  for (const StoredRun& run : Store::open(folder / "moved").runs()) ++variants[run.variant];
  EXPECT_EQ(variants, (std::map<std::string, int>{{"ball", 6}, {"reference", 6}, {"soft rain", 6}}));
}

TEST(ChartStudy, RungsOfOneSeedDoNotSupersedeEachOther) {
  const test::TemporaryFolder folder;
  run_sweep(document_of(charted(small_chart())), folder / "study", with_fake_run());
  for (const StoredRun& run : runs_of(Store::open(folder / "study")))
    EXPECT_FALSE(run.superseded) << run.variant;
}

/// What was the reference of a ladder is a rung of the next: its runs are kept, named anew and told apart
/// from those of the new reference, of the same frictions and seeds; and so when the first ladder returns.
TEST(ChartStudy, RunsTakeTheNameThatTheLadderGivesThemNow) {
  const test::TemporaryFolder folder;
  const Json before = small_chart();
  Json after = before;
  after["reference"] = {{"/numerics/stiffness_scale", 0.5}};
  after["rungs"] =
      Json::array({{{"name", "former"},
                    {"set", {{"/numerics/stiffness_scale", 1.0}, {"/numerics/time_step_fraction", 0.1}}}}});
  const auto left_of_variants = [&](const Json& chart) {
    run_sweep(document_of(charted(chart)), folder / "study", with_fake_run());
    std::map<std::string, int> variants;
    for (const StoredRun& run : runs_of(Store::open(folder / "study")))
      if (run.point && !run.superseded) ++variants[run.variant];
    return variants;
  };
  const auto first = left_of_variants(before);
  EXPECT_EQ(left_of_variants(after), (std::map<std::string, int>{{"former", 6}, {"reference", 6}}));
  EXPECT_EQ(left_of_variants(before), first);
}

}  // namespace
}  // namespace repose::sweep
