#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

/// Coarse enough for a few seconds.
std::vector<std::string> arguments(const std::string& file, const std::string& folder,
                                   const std::vector<std::string>& more) {
  std::vector<std::string> all{"stability",   file,  "--out",    folder, "--quiet",     "--bodies", "20",
                               "--precision", "0.4", "--scales", "1",    "--tolerance", "0.25"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(Stability, WritesTheMapAndRecommendsAStepTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const std::string one = (folder / "one").string(), two = (folder / "two").string();
  const Finished json = repose(arguments(file, one, {"--json", "--threads", "1"}));
  ASSERT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(json.err, "");
  const Json map = Json::parse(json.out);
  EXPECT_EQ(map.at("rows").size(), 3U + 3U * 15U);
  EXPECT_FALSE(map.at("interrupted").get<bool>());
  const Json& found = map.at("recommendation");
  EXPECT_EQ(found.at("integrator"), "symplectic_euler");
  EXPECT_DOUBLE_EQ(found.at("time_step_s").get<double>() * found.at("safety_margin").get<double>(),
                   found.at("largest_stable_step_s").get<double>());
  EXPECT_GT(found.at("auto_margin").get<double>(), 1.0);
  for (const Json& row : map.at("rows")) {
    ASSERT_FALSE(row.at("largest_stable_step_s").is_null()) << row;
    EXPECT_LT(row.at("largest_stable_step_s").get<double>(),
              row.at("smallest_unstable_step_s").get<double>());
    EXPECT_GE(row.at("largest_stable_step_s").get<double>() * 1.4,
              row.at("smallest_unstable_step_s").get<double>());
  }
  EXPECT_EQ(Json::parse(text_of(one + "/stability.json")), map);
  EXPECT_EQ(lines_with(text_of(one + "/stability.csv"), ","), 1 + 48);
  for (const std::string name :
       {"energy_elastic_pair", "energy_settled_column", "energy_flat_clump", "energy_slump", "largest_steps"})
    for (const std::string ending : {".svg", ".png"})
      EXPECT_GT(std::filesystem::file_size(one + "/" + name + ending), 1000U) << name << ending;

  const Finished words = repose(arguments(file, two, {"--threads", "2"}));
  ASSERT_EQ(words.code, 0) << words.err;
  EXPECT_EQ(words.err, "");
  EXPECT_NE(words.out.find("Largest stable step"), std::string::npos);
  EXPECT_NE(words.out.find("the first to fail is"), std::string::npos);
  for (const std::string name : {"/stability.csv", "/energy_error.csv", "/stability.json"})
    EXPECT_EQ(text_of(one + name), text_of(two + name)) << name;
}

TEST(Stability, BadInputIsReportedWholeAndNothingIsWritten) {
  const TemporaryFolder folder;
  Json bad = tiny_case();
  bad["particles"]["density_kg_m3"] = -1;
  const std::string file = write_case(folder, bad);
  const std::string out = (folder / "map").string();
  const Finished answer =
      repose({"stability", file, "--out", out, "--scales", "1,-2", "--precision", "7", "--tolerance", "0",
              "--bodies", "1", "--threads", "0", "--seed", "-1", "--set", "mu_s=-1"});
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.out, "");
  for (const std::string fault : {"/particles/density_kg_m3 = -1", "static_friction", "--scales",
                                  "--precision", "--tolerance", "--bodies", "--threads", "--seed"})
    EXPECT_NE(answer.err.find(fault), std::string::npos) << fault << "\n" << answer.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Stability, CtrlCEndsItInOrderWith130) {
  const TemporaryFolder folder;
  Json json = tiny_case();
  json["particles"]["shear_modulus_Pa"] = 5e9;  // fifty times as many steps
  const std::string out = (folder / "map").string();
  Process map(REPOSE_PROGRAM, {"stability", write_case(folder, json), "--out", out, "--json"});
  ASSERT_TRUE(eventually([&] { return map.err_so_far().find("experiments done") != std::string::npos; }));
  map.send(SIGINT);
  const Finished finished = map.wait();
  EXPECT_EQ(finished.code, 130);
  const Json printed = Json::parse(finished.out);
  EXPECT_TRUE(printed.at("interrupted").get<bool>());
  EXPECT_LT(printed.at("rows").size(), 144U);
  EXPECT_EQ(lines_with(text_of(out + "/stability.csv"), ","),
            1 + static_cast<int>(printed.at("rows").size()));
}

// A column too soft to stand: the pair and the flat clump are mapped, no step is recommended.
TEST(Stability, SaysWhyNoStepCanBeRecommended) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_case());
  const Finished answer = repose(
      arguments(file, (folder / "map").string(), {"--json", "--set", "/numerics/stiffness_scale=1e-4"}));
  EXPECT_EQ(answer.code, 3) << answer.err;
  const Json map = Json::parse(answer.out);
  EXPECT_TRUE(map.at("recommendation").is_null());
  EXPECT_NE(map.at("reason").get<std::string>().find("settled_column"), std::string::npos);
}

}  // namespace
}  // namespace repose::test
