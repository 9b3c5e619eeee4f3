// repose calibrate and report: from a case and a measured angle to friction values and a page.

#include <gtest/gtest.h>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

namespace fs = std::filesystem;

Finished calibrated(const std::string& file, const fs::path& out, const std::string& angle,
                    const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"calibrate", file, "--angle", angle, "--out", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return repose(arguments);
}

int pictures_in(const std::string& page) {
  int count = 0;
  for (std::size_t at = page.find("src=\"data:"); at != std::string::npos;
       at = page.find("src=\"data:", at + 1))
    ++count;
  return count;
}

TEST(Calibrate, GoesFromACaseAndAnAngleToFrictionAndAPage) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_sweep(2));
  const fs::path out = folder / "calibration";
  const Finished words = calibrated(file, out, "27", {"--sigma", "1"});
  ASSERT_EQ(words.code, 0) << words.err;
  EXPECT_NE(words.out.find("μs"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find("27° ± 1°"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find((out / "report.html").string()), std::string::npos) << words.out;
  const std::string page = text_of(out / "report.html");
  EXPECT_NE(page.find("</html>"), std::string::npos);
  // Two charts, and of the runs with the lowest, the nearest and the highest angle the heap and the profiles;
  // one run may be two of them.
  EXPECT_GE(pictures_in(page), 2 + 2 * 2);
  EXPECT_LE(pictures_in(page), 2 + 3 * 2);

  // The same again, as JSON: nothing is simulated any more, and the answer is the one of fit and invert.
  const Finished again = calibrated(file, out, "27", {"--sigma", "1", "--json"});
  ASSERT_EQ(again.code, 0) << again.err;
  const Json json = Json::parse(again.out);
  EXPECT_EQ(json.at("sweep").at("finished"), 0);
  EXPECT_EQ(json.at("fit"), Json::parse(repose({"fit", out.string(), "--json"}).out));
  EXPECT_EQ(json.at("inversion"),
            Json::parse(repose({"invert", out.string(), "--angle", "27", "--sigma", "1", "--json"}).out));
  EXPECT_TRUE(fs::exists(json.at("report").get<std::string>()));
  // Heaps of 300 spheres are flat, and the step of 0.3 T_R is coarse for them: counted in answer, page and
  // status.
  const int flat = json.at("warnings").at("flat_heap").at("runs");
  EXPECT_GT(flat, 0);
  EXPECT_NE(words.out.find(std::to_string(flat) + " × flat_heap: "), std::string::npos) << words.out;
  EXPECT_NE(page.find("<td>flat_heap</td>"), std::string::npos);
  const Json status = Json::parse(repose({"status", out.string(), "--json"}).out);
  EXPECT_GE(status.at("warnings").at("flat_heap").at("runs").get<int>(), flat);
  EXPECT_NE(words.out.find(json.at("answer").get<std::string>()), std::string::npos);

  // The report alone, again: asked what it was asked before, or something new.
  fs::remove(out / "report.html");
  fs::remove_all(out / "heaps");
  const Finished report = repose({"report", out.string()});
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_NE(report.out.find("27° ± 1°"), std::string::npos) << report.out;
  EXPECT_EQ(pictures_in(text_of(out / "report.html")), pictures_in(page));
  const Finished other = repose({"report", out.string(), "--angle", "26", "--quiet"});
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_NE(other.out.find("26°"), std::string::npos) << other.out;
  // Without an angle it is the last question with what is typed now.
  const Finished fixed = repose({"report", out.string(), "--fix", "mu_r=0.15", "--json"});
  EXPECT_EQ(fixed.code, 0) << fixed.err;
  EXPECT_EQ(Json::parse(fixed.out).at("inversion").at("angle_deg"), 26.0);
  EXPECT_EQ(Json::parse(fixed.out).at("inversion").at("solution").at("mu_r"), 0.15);
  const Finished bad = repose({"report", out.string(), "--sigma", "-5", "--fix", "mu_q=1"});
  EXPECT_EQ(bad.code, 2);
  for (const char* word : {"--sigma: -5", "mu_q=1"})
    EXPECT_NE(bad.err.find(word), std::string::npos) << word << " in\n" << bad.err;
}

TEST(Report, NeedsAnAngleBeforeAnythingCanBeFixed) {
  const TemporaryFolder folder;
  const fs::path out = folder / "study";
  ASSERT_EQ(repose({"sweep", write_case(folder, tiny_sweep()), "--out", out.string()}).code, 0);
  const Finished run = repose({"report", out.string(), "--fix", "mu_r=0.2"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("--fix: needs --angle"), std::string::npos) << run.err;
}

TEST(Calibrate, AnAngleOutOfReachEndsWithTwoButThePageIsThere) {
  const TemporaryFolder folder;
  const fs::path out = folder / "calibration";
  const Finished run = calibrated(write_case(folder, tiny_sweep()), out, "80", {"--json"});
  EXPECT_EQ(run.code, 2);
  const Json json = Json::parse(run.out);
  ASSERT_EQ(json.at("reachable_deg").size(), 2U);
  EXPECT_LT(json.at("reachable_deg").at(1).get<double>(), 80.0);
  EXPECT_FALSE(json.contains("inversion"));
  EXPECT_NE(text_of(out / "report.html").find("</html>"), std::string::npos);
}

TEST(Calibrate, EveryFaultIsSaidBeforeAnythingRuns) {
  const TemporaryFolder folder;
  Json json = tiny_sweep();
  json["sweep"]["replicates"] = 0;
  const fs::path out = folder / "calibration";
  const Finished run = calibrated(write_case(folder, json), out, "95", {"--sigma", "-1", "--fix", "mu_r"});
  EXPECT_EQ(run.code, 2);
  for (const std::string word : {"--angle: 95", "--sigma: -1", "--fix: mu_r", "/sweep/replicates"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  EXPECT_FALSE(fs::exists(out));
}

TEST(Calibrate, ADesignThatCannotGiveAnEquationIsRefusedBeforeItRuns) {
  const TemporaryFolder folder;
  Json json = tiny_sweep();
  json["sweep"]["factors"] = {{"mu_s", {0.3, 0.7}}};
  const fs::path out = folder / "calibration";
  const Finished run = calibrated(write_case(folder, json), out, "27");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("no equation can be fitted"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(out));
}

TEST(Calibrate, AQuestionThatTheDesignCannotAnswerIsRefusedBeforeItRuns) {
  const TemporaryFolder folder;
  const fs::path out = folder / "calibration";
  const std::string file = write_case(folder, tiny_sweep());
  const Finished outside = calibrated(file, out, "27", {"--fix", "mu_s=7"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.err.find("mu_s = 7: outside the domain"), std::string::npos) << outside.err;
  const Finished both = calibrated(file, out, "27", {"--fix", "mu_s=0.5", "mu_r=0.15"});
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("nothing is left to solve for"), std::string::npos) << both.err;
  EXPECT_FALSE(fs::exists(out));
}

TEST(Calibrate, CtrlCKeepsWhatIsFinished) {
  const TemporaryFolder folder;
  const std::string file = write_case(folder, tiny_sweep(4));
  const fs::path out = folder / "calibration";
  Process run(REPOSE_PROGRAM, {"calibrate", file, "--angle", "27", "--out", out.string(), "--threads", "1"});
  ASSERT_TRUE(eventually([&] {
    const Finished status = repose({"status", out.string(), "--json"});
    return status.code == 0 && Json::parse(status.out).at("done") >= 1;
  }));
  run.send(SIGINT);
  EXPECT_EQ(run.wait().code, 130);
  EXPECT_FALSE(fs::exists(out / "report.html"));
  EXPECT_GE(Json::parse(repose({"status", out.string(), "--json"}).out).at("done").get<int>(), 1);
}

}  // namespace
}  // namespace repose::test
