// repose simulate: one slump test from the command line.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

namespace fs = std::filesystem;

/// A result without what depends on the machine's speed.
Json without_cpu_time(const std::string& text) {
  Json json = Json::parse(text);
  json.at("cost").erase("cpu_s");
  return json;
}

TEST(Simulate, GivesOneJsonObjectWithEveryKeyOfTheContract) {
  const TemporaryFolder folder;
  const Finished run = repose({"simulate", write_case(folder, tiny_case()), "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("outcome"), "completed");
  EXPECT_TRUE(json.at("reason").is_string());
  const double angle = json.at("angle_of_repose_deg");
  ASSERT_EQ(json.at("angles_deg").size(), 4U);
  double sum = 0.0;
  for (const double flank : json.at("angles_deg")) sum += flank;
  // α = (α1 + … + α4) / 4, article eq. 12; the tolerance is that of printing with 17 digits.
  EXPECT_NEAR(angle, sum / 4.0, 1e-12 * angle);
  EXPECT_GT(angle, 3.0);
  EXPECT_LT(angle, 60.0);
  EXPECT_GT(json.at("angle_standard_error_deg").get<double>(), 0.0);
  const Json& responses = json.at("responses");
  EXPECT_GT(responses.at("mass_on_base_kg").get<double>(), 0.0);
  EXPECT_LE(responses.at("mass_on_base_kg").get<double>(), 0.0251);
  EXPECT_GT(responses.at("peak_height_mm").get<double>(), 5.0);
  // A random packing of equal spheres fills between 0.5 and 0.74 of a volume; walls loosen it further.
  EXPECT_GT(responses.at("bulk_density_kg_m3").get<double>(), 0.45 * 2500.0);
  EXPECT_LT(responses.at("bulk_density_kg_m3").get<double>(), 0.74 * 2500.0);
  EXPECT_GT(responses.at("rest_time_s").get<double>(), 0.0);
  const Json& cost = json.at("cost");
  EXPECT_GT(cost.at("cpu_s").get<double>(), 0.0);
  EXPECT_GT(cost.at("steps").get<long>(), 1000);
  // Δt = 0.3 π R √(ρ/G) / (0.163 ν + 0.8766), article eq. 9, by hand for R = 2.5 mm.
  const double step = 0.3 * M_PI * 0.002 * std::sqrt(2500.0 / 2e6) / (0.163 * 0.25 + 0.8766);
  EXPECT_NEAR(cost.at("time_step_s").get<double>(), step, 1e-3 * step);
  // 25 g of spheres of 4 mm and 2500 kg/m³ are 298.4 of them.
  EXPECT_NEAR(json.at("bodies").get<double>(), 298.4, 1.0);
  EXPECT_EQ(json.at("spheres"), json.at("bodies"));
  EXPECT_EQ(json.at("seed"), 1);
  EXPECT_EQ(json.at("run_key").get<std::string>().size(), 32U);
}

TEST(Simulate, ShowsStageTimeAndEnergyWhileItRunsUnlessQuiet) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished loud = repose({"simulate", file});
  EXPECT_EQ(loud.code, 0);
  EXPECT_NE(loud.err.find("pour"), std::string::npos) << loud.err;
  EXPECT_NE(loud.err.find("kinetic energy"), std::string::npos) << loud.err;
  EXPECT_NE(loud.out.find("angle of repose"), std::string::npos) << loud.out;
  EXPECT_EQ(repose({"simulate", file, "--quiet"}).err, "");
}

TEST(Simulate, IsAFunctionOfCaseAndSeed) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished first = repose({"simulate", file, "--seed", "5", "--json"});
  const Finished again = repose({"simulate", file, "--seed", "5", "--json"});
  const Finished other = repose({"simulate", file, "--seed", "6", "--json"});
  EXPECT_EQ(without_cpu_time(first.out), without_cpu_time(again.out));
  EXPECT_NE(Json::parse(first.out).at("run_key"), Json::parse(other.out).at("run_key"));
  EXPECT_NE(Json::parse(first.out).at("angle_of_repose_deg"),
            Json::parse(other.out).at("angle_of_repose_deg"));
}

TEST(Simulate, IsTheSameOnSeveralThreads) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  for (const std::string arithmetic : {"double", "mixed"}) {
    const std::string set = "/numerics/arithmetic=" + arithmetic;
    const Finished alone = repose({"simulate", file, "--json", "--set", set});
    EXPECT_EQ(without_cpu_time(alone.out),
              without_cpu_time(repose({"simulate", file, "--threads", "3", "--json", "--set", set}).out));
  }
  const Finished none = repose({"simulate", file, "--threads", "0"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("--threads: 0: must be between 1 and 16"), std::string::npos) << none.err;
}

TEST(Simulate, TakesTheCaseBehindItsSettings) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished before = repose({"simulate", file, "--json", "--set", "mu_s=0.8", "mu_r=0.02"});
  const Finished behind = repose({"simulate", "--json", "--set", "mu_s=0.8", "mu_r=0.02", file});
  EXPECT_EQ(without_cpu_time(before.out), without_cpu_time(behind.out)) << behind.err;
  const Finished no_value = repose({"simulate", file, "--set", "mu_s", "mu_r=0.02"});
  EXPECT_EQ(no_value.code, 2);
  EXPECT_NE(no_value.err.find("mu_s"), std::string::npos) << no_value.err;
}

TEST(Simulate, SetByFactorAndByPointerAreTheSameAndChangeTheRunsKey) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished plain = repose({"simulate", file, "--json"});
  const Finished factor = repose({"simulate", file, "--set", "mu_s=0.8", "mu_r=0.02", "--json"});
  const Finished pointer =
      repose({"simulate", file, "--set", "/contact/particle_particle/static_friction=0.8", "--set",
              "/contact/particle_particle/rolling_friction=0.02", "--json"});
  EXPECT_EQ(without_cpu_time(factor.out), without_cpu_time(pointer.out));
  EXPECT_NE(Json::parse(plain.out).at("run_key"), Json::parse(factor.out).at("run_key"));
}

TEST(Simulate, OutHoldsResultHeapAndPicture) {
  const TemporaryFolder folder;
  const fs::path out = folder / "deep/er";
  const Finished run = repose({"simulate", write_case(folder, tiny_case()), "--out", out.string(), "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(text_of(out / "result.json")), Json::parse(run.out));
  EXPECT_NE(text_of(out / "heap.dump").find("ITEM: ATOMS"), std::string::npos);
  for (const char* name : {"heap_spheres.vtp", "heap_bodies.vtp", "heap_walls.vtp"})
    EXPECT_NE(text_of(out / name).find("PolyData"), std::string::npos) << name;
  for (const char* name : {"profile.png", "heap.png"})
    EXPECT_TRUE(text_of(out / name).starts_with("\x89PNG")) << name;
}

TEST(Simulate, FramesMakeASeriesOfThatLength) {
  const TemporaryFolder folder;
  const fs::path out = folder / "film";
  const Finished run =
      repose({"simulate", write_case(folder, tiny_case()), "--frames", "7", "--out", out.string()});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(lines_with(text_of(out / "film_spheres.pvd"), "<DataSet"), 7);
}

TEST(Simulate, RunThatDoesNotCompleteEndsWithThreeAndItsReason) {
  const TemporaryFolder folder;
  Json json = tiny_case();
  json["numerics"]["stage_time_limit_s"] = 0.002;
  const Finished run = repose({"simulate", write_case(folder, json), "--json"});
  EXPECT_EQ(run.code, 3);
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result.at("outcome"), "timed_out");
  EXPECT_NE(result.at("reason"), "");
  EXPECT_TRUE(result.at("angle_of_repose_deg").is_null());
}

TEST(Simulate, NamesItsWarningsInWordsAndInJson) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const std::vector<std::string> set = {"--set", "mu_s=1.5", "/test/opening_speed_m_s=0.1",
                                        "/numerics/time_step_fraction=0.2", "--quiet"};
  std::vector<std::string> words = {"simulate", file}, json = {"simulate", file, "--json"};
  words.insert(words.end(), set.begin(), set.end());
  json.insert(json.end(), set.begin(), set.end());
  const std::string text = repose(words).out;
  EXPECT_EQ(lines_with(text, "warning high_friction: μs = 1.5 between particles"), 1) << text;
  EXPECT_EQ(lines_with(text, "warning slow_opening: opened at 0.1 m/s"), 1) << text;
  std::set<std::string> names;
  const Json result = Json::parse(repose(json).out);
  for (const Json& warning : result.at("warnings")) {
    names.insert(warning.at("name"));
    EXPECT_FALSE(warning.at("text").get<std::string>().empty());
  }
  EXPECT_TRUE(names.contains("high_friction") && names.contains("slow_opening")) << result;
  EXPECT_TRUE(result.at("responses").at("reaches_edge").is_boolean());
  EXPECT_GE(result.at("responses").at("mass_lost_kg").get<double>(), 0.0);
  EXPECT_GT(result.at("motion").at("stability_number").get<double>(), 0.0);
}

TEST(Simulate, AStepThatIsTooLargeNeverGivesAnAngle) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  for (const char* step : {"0.5", "2", "1000"}) {
    const Finished run =
        repose({"simulate", file, "--json", "--set", std::string("/numerics/time_step_fraction=") + step});
    EXPECT_EQ(run.code, 3);
    const Json json = Json::parse(run.out);
    EXPECT_TRUE(json.at("outcome") == "unstable" || json.at("outcome") == "escaped") << json;
    EXPECT_NE(json.at("reason").get<std::string>().find("smaller"), std::string::npos) << json;
    EXPECT_TRUE(json.at("angle_of_repose_deg").is_null());
  }
}

TEST(Simulate, NumbersThatAreNotFiniteAreRefused) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  for (const char* value : {"1e999", "-1e999", "nan", "NaN", "inf"})
    EXPECT_EQ(repose({"simulate", file, "--set", std::string("mu_s=") + value}).code, 2) << value;
  std::string text = tiny_case().dump();
  text.replace(text.find("2500"), 4, "1e999");
  write_text(folder / "huge.json", text);
  EXPECT_EQ(repose({"simulate", (folder / "huge.json").string()}).code, 2);
}

TEST(Simulate, CtrlCEndsItInOrderWith130) {
  const TemporaryFolder folder;
  Json json = tiny_case();
  json["particles"]["shear_modulus_Pa"] = 5e11;  // a thousand times as many steps
  Process run(REPOSE_PROGRAM, {"simulate", write_case(folder, json), "--json"});
  ASSERT_TRUE(eventually([&] { return run.err_so_far().find("pour") != std::string::npos; }));
  run.send(SIGINT);
  const Finished finished = run.wait();
  EXPECT_EQ(finished.code, 130);
  EXPECT_EQ(Json::parse(finished.out).at("outcome"), "interrupted");
}

TEST(Simulate, EveryFaultOfCaseAndOptionsComesAtOnceAndNothingIsWritten) {
  const TemporaryFolder folder;
  Json json = tiny_case();
  json["particles"]["density_kg_m3"] = -1;
  json["contact"]["particle_particle"]["restitution"] = 1.5;
  json["test"]["colour"] = "red";
  const std::string file = write_case(folder, json);
  const fs::path out = folder / "out";
  const Finished run = repose({"simulate", file, "--out", out.string(), "--set", "mu_q=1", "--frames", "-3",
                               "--seed", "-1", "--json"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find(file + ": /particles/density_kg_m3 = -1: must be > 0"), std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("/contact/particle_particle/restitution = 1.5"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("/test/colour"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("mu_q"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--frames"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--seed: -1"), std::string::npos) << run.err;
  EXPECT_EQ(Json::parse(run.out).at("faults").size(), 6U) << run.out;
  EXPECT_FALSE(fs::exists(out));
}

TEST(Simulate, SeedsAreWholeNumbersThatEveryReaderKeeps) {
  const TemporaryFolder folder;
  Json json = tiny_case();
  const std::string file = write_case(folder, json);
  for (const std::string seed : {"99999999999999999999", "1.5", "x", "-4"}) {
    const Finished run = repose({"simulate", file, "--seed", seed});
    EXPECT_EQ(run.code, 2) << seed;
    EXPECT_NE(run.err.find("--seed: " + seed + ": must be an integer from 0 to"), std::string::npos)
        << run.err;
  }
  json["sweep"] = {{"seed", -4}};
  const Finished run = repose({"simulate", write_case(folder, json)});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("/sweep/seed = -4: must be an integer"), std::string::npos) << run.err;
}

TEST(Simulate, FolderThatCannotBeWrittenIsSaidBeforeTheRun) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished run = repose({"simulate", file, "--out", file + "/below"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("cannot be written"), std::string::npos) << run.err;
  EXPECT_EQ(lines_with(run.err, "pour"), 0) << "it must not have run";
}

TEST(Simulate, FramesNeedAFolder) {
  const TemporaryFolder folder;
  const Finished run = repose({"simulate", write_case(folder, tiny_case()), "--frames", "3"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("needs --out"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace repose::test
