// repose chart: a ladder of simplifications against a reference, and the choice among its combinations.

#include <gtest/gtest.h>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

namespace fs = std::filesystem;

/// The tiny case with a ladder of its own: a rung that changes nothing that can be seen, one that ends early,
/// one that cannot complete.
Json tiny_chart(int replicates = 2) {
  Json json = tiny_case();
  json["particles"]["total_mass_kg"] = 0.035;  // a heap that can be read whatever the rounding
  json["chart"] = Json::parse(R"({
    "reference": {"/numerics/rest_energy_ratio": 1e-6},
    "rungs": [{"name": "faster rest", "set": {"/numerics/rest_energy_ratio": 1e-4}},
              {"name": "less mass", "set": {"/particles/total_mass_kg": 0.03}},
              {"name": "no time", "set": {"/numerics/stage_time_limit_s": 0.002}}],
    "frictions": [{"mu_s": 0.7, "mu_r": 0.2}, {"mu_s": 0.7, "mu_r": 0.1}, {"mu_s": 0.3, "mu_r": 0.2}],
    "seed": 3})");
  json["chart"]["replicates"] = replicates;
  return json;
}

Finished chart(const TemporaryFolder& folder, const std::string& name, const Json& json,
               const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments = {"chart", write_case(folder, json), "--out", (folder / name).string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return repose(arguments);
}

/// All of chart.json that does not depend on the machine's speed.
Json without_times(Json json) {
  json.erase("sweep");
  json["reference"].erase("cpu_s");
  for (Json& rung : json["rungs"])
    for (const char* key : {"cpu_s", "speed_up", "on_front"}) rung.erase(key);
  return json;
}

TEST(Chart, WritesTableAndPictureAndNamesWhatFailed) {
  const TemporaryFolder folder;
  const Finished run = chart(folder, "study", tiny_chart(), {"--json"});
  ASSERT_EQ(run.code, 3) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("reference").at("angle_deg").size(), 3U);
  EXPECT_EQ(json.at("engines").size(), 1U);
  ASSERT_EQ(json.at("rungs").size(), 3U);
  const Json& rest = json.at("rungs")[0];
  EXPECT_EQ(rest.at("name"), "faster rest");
  EXPECT_TRUE(rest.at("completed"));
  EXPECT_EQ(rest.at("by_friction").size(), 3U);
  // The same motion, only stopped earlier: the column is the same to the last bit.
  EXPECT_EQ(rest.at("density_difference_percent").at("value"), 0.0);
  EXPECT_LT(json.at("rungs")[1].at("mass_difference_percent").at("value"), -4.0);
  const Json& failed = json.at("rungs")[2];
  EXPECT_FALSE(failed.at("completed"));
  EXPECT_EQ(failed.at("outcomes").at("timed_out"), 6);
  EXPECT_NE(failed.at("reason"), "");
  EXPECT_TRUE(failed.at("error_deg").is_null());
  EXPECT_EQ(Json::parse(text_of(folder / "study/chart.json")), json);
  EXPECT_EQ(lines_with(text_of(folder / "study/chart.csv"), "\""), 3);
  EXPECT_NE(text_of(folder / "study/chart.svg").find("timed_out"), std::string::npos);
  EXPECT_TRUE(text_of(folder / "study/chart.png").starts_with("\x89PNG"));
  EXPECT_FALSE(fs::exists(folder / "study/chosen.json"));
}

TEST(Chart, SecondCallRunsNothingAndThreadsChangeNothing) {
  const TemporaryFolder folder;
  const Finished one = chart(folder, "study", tiny_chart(), {"--json", "--threads", "1"});
  const Finished again = chart(folder, "study", tiny_chart(), {"--json"});
  EXPECT_EQ(Json::parse(again.out).at("sweep").at("finished"), 0);
  EXPECT_EQ(without_times(Json::parse(again.out)), without_times(Json::parse(one.out)));
  const Finished two = chart(folder, "other", tiny_chart(), {"--json", "--threads", "2"});
  EXPECT_EQ(without_times(Json::parse(two.out)), without_times(Json::parse(one.out)));
}

TEST(Chart, AfterCtrlCItGoesOnAndTheChartIsTheSame) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_chart());
  const fs::path study = folder / "stopped";
  const auto done = [&] {
    const Finished status = repose({"status", study.string(), "--json"});
    return status.code == 0 ? Json::parse(status.out).at("done").get<int>() : 0;
  };
  Process process(REPOSE_PROGRAM, {"chart", file, "--out", study.string(), "--threads", "1"});
  EXPECT_TRUE(eventually([&] { return done() >= 1; }));
  process.send(SIGINT);
  EXPECT_EQ(process.wait().code, 130);
  EXPECT_LT(done(), 24) << "the chart was to be stopped half way";
  EXPECT_FALSE(fs::exists(study / "chart.json"));
  const Finished rest = chart(folder, "stopped", tiny_chart(), {"--json"});
  const Finished whole = chart(folder, "whole", tiny_chart(), {"--json"});
  EXPECT_EQ(without_times(Json::parse(rest.out)), without_times(Json::parse(whole.out)));
}

TEST(Chart, StoppedHalfWayItShowsTheReplicatesThatAreThere) {
  const TemporaryFolder folder;
  const Json two = Json::parse(chart(folder, "study", tiny_chart(2), {"--json"}).out);
  // 48 runs more: with the first of them the chart is stopped long before the last.
  const std::string file = write_case(folder, tiny_chart(6));
  const auto done = [&] {
    const Finished status = repose({"status", (folder / "study").string(), "--json"});
    return status.code == 0 ? Json::parse(status.out).at("done").get<int>() : 0;
  };
  Process process(REPOSE_PROGRAM,
                  {"chart", file, "--out", (folder / "study").string(), "--threads", "1", "--json"});
  EXPECT_TRUE(eventually([&] { return done() > 24; }));
  process.send(SIGINT);
  const Finished stopped = process.wait();
  EXPECT_EQ(stopped.code, 130);
  const Json so_far = Json::parse(stopped.out).at("so_far");
  EXPECT_GE(so_far.at("replicates"), 2);
  EXPECT_LT(so_far.at("replicates"), 6);
  EXPECT_GT(so_far.at("missing_runs"), 0);
  EXPECT_EQ(so_far.at("rungs").size() + so_far.at("unfinished").size(), 3U);
  if (so_far.at("replicates") == 2) {
    EXPECT_EQ(so_far.at("rungs")[0].at("by_friction"), two.at("rungs")[0].at("by_friction"));
  }
  // What was written when the chart was whole stays as it was.
  EXPECT_EQ(Json::parse(text_of(folder / "study/chart.json")), two);
}

TEST(Chart, NamesFilesAsTheyAreFoundFromItsFolder) {
  const TemporaryFolder folder;
  Json json = tiny_chart(2);
  const Json clump = Json::parse(R"([{"clump": "clump.json"}])");
  fs::copy_file(fs::path(__FILE__).parent_path() / "../../cases/shapes/particle_13_5.json",
                folder / "clump.json");
  json["chart"]["rungs"] = Json::array({{{"name", "clumps"}, {"set", {{"/particles/shapes", clump}}}}});
  const Finished run = chart(folder, "study", json, {"--json"});
  const Json rung = Json::parse(run.out).at("rungs")[0];
  const std::string name = rung.at("set").at("/particles/shapes")[0].at("clump");
  EXPECT_TRUE(fs::exists(folder / "study" / name)) << name;
}

TEST(Chart, ChoosesConfirmsAndWritesACaseThatInherits) {
  const TemporaryFolder folder;
  Json json = tiny_chart(3);
  json["chart"]["rungs"].erase(2);
  json["chart"]["rungs"][1] = {{"name", "faster settling"},
                               {"set", {{"/numerics/settle_energy_ratio", 1e-2}}}};
  // Any error will do: what is looked at is that it is chosen, run as it is and written.
  const Finished run = chart(folder, "study", json, {"--json", "--choose", "60"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(run.out);
  const Json& choice = result.at("choice");
  ASSERT_EQ(choice.at("trials").size(), 1U) << choice;
  EXPECT_EQ(choice.at("chosen"), choice.at("trials")[0].at("name"));
  EXPECT_TRUE(choice.at("trials")[0].at("completed"));
  EXPECT_GT(choice.at("trials")[0].at("predicted").at("error_bound_95_deg"), 0.0);
  const Json chosen = Json::parse(text_of(folder / "study/chosen.json"));
  EXPECT_EQ(chosen.at("base"), "../case.json");
  // Whatever was the cheapest: it is the reference's setting unless a rung of the combination sets it.
  const bool rests = choice.at("chosen").get<std::string>().find("faster rest") != std::string::npos;
  EXPECT_EQ(chosen.at("numerics").at("rest_energy_ratio"), rests ? 1e-4 : 1e-6);
  const Finished simulated = repose({"simulate", (folder / "study/chosen.json").string(), "--set", "mu_s=0.7",
                                     "--set", "mu_r=0.2", "--json"});
  EXPECT_EQ(simulated.code, 0) << simulated.err;
}

TEST(Chart, ChoosesOnTheWorkingPointThatRungsStandOn) {
  const TemporaryFolder folder;
  Json json = tiny_chart(2);
  json["chart"]["working_point"] = {{"/numerics/rest_energy_ratio", 1e-4},
                                    {"/numerics/settle_energy_ratio", 1e-3}};
  json["chart"]["rungs"] = Json::parse(R"([
    {"name": "faster settling", "set": {"/numerics/settle_energy_ratio": 1e-2}},
    {"name": "instant", "set": {"/test/opening": "instant"}}])");
  // Any error will do: every combination is the working point with what its rungs set.
  const Finished run = chart(folder, "study", json, {"--json", "--choose", "60"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json result = Json::parse(run.out);
  const Json& rungs = result.at("rungs");
  EXPECT_EQ(rungs[0].at("name"), "working point");
  EXPECT_EQ(rungs[0].at("off_working_point_deg").at("value"), 0.0);
  // A rung's difference to the working point is that of their differences to the reference: the same runs.
  const auto value = [](const Json& rung, const char* key) { return rung.at(key).at("value").get<double>(); };
  EXPECT_NEAR(value(rungs[1], "off_working_point_deg"),
              value(rungs[1], "angle_difference_deg") - value(rungs[0], "angle_difference_deg"), 1e-9);
  const std::string name = result.at("choice").at("chosen");
  const Json chosen = Json::parse(text_of(folder / "study/chosen.json"));
  EXPECT_EQ(chosen.at("numerics").at("rest_energy_ratio"), 1e-4);
  EXPECT_EQ(chosen.at("numerics").at("settle_energy_ratio"),
            name.find("faster settling") != std::string::npos ? 1e-2 : 1e-3);
  EXPECT_EQ(chosen.contains("test"), name.find("instant") != std::string::npos);
}

TEST(Chart, SaysWhereNothingCanBeChosen) {
  const TemporaryFolder folder;
  Json json = tiny_chart(2);
  json["chart"]["rungs"] = {{{"name", "less mass"}, {"set", {{"/particles/total_mass_kg", 0.03}}}}};
  chart(folder, "study", json);
  write_text(folder / "study/chosen.json", "{}");
  const Finished run = chart(folder, "study", json, {"--json", "--choose", "0.001"});
  EXPECT_EQ(run.code, 3) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_TRUE(result.at("choice").at("chosen").is_null());
  // What an earlier call chose is gone with it.
  EXPECT_NE(result.at("choice").at("remark").get<std::string>().find("replicates"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "study/chosen.json"));
  EXPECT_TRUE(fs::exists(folder / "study/chart.json"));
}

TEST(Chart, SaysWhereTheReferenceFails) {
  const TemporaryFolder folder;
  Json json = tiny_chart(2);
  json["chart"]["reference"] = {{"/numerics/stage_time_limit_s", 0.002}};
  const Finished run = chart(folder, "study", json, {"--json"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("reference"), std::string::npos) << run.err;
  EXPECT_NE(Json::parse(run.out).at("error").get<std::string>().find("timed_out"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "study/chart.json"));
}

TEST(Chart, EveryFaultComesAtOnceAndNothingIsWritten) {
  const TemporaryFolder folder;
  Json json = tiny_chart();
  json["chart"]["rungs"][0]["set"]["/numerics/rest_energy_ratio"] = -1;
  json["chart"]["replicates"] = 1;
  json["walls"]["poisson_ratio"] = 0.7;
  const Finished run =
      chart(folder, "study", json, {"--choose", "-1", "--tries", "0", "--threads", "0", "--json"});
  EXPECT_EQ(run.code, 2);
  for (const std::string word :
       {"/chart/replicates", "/walls/poisson_ratio", "--choose", "--tries", "--threads"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  EXPECT_FALSE(fs::exists(folder / "study"));
}

}  // namespace
}  // namespace repose::test
