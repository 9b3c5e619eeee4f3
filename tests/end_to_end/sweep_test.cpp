// repose sweep, status, export, merge: many runs, kept whatever happens in between.

#include <gtest/gtest.h>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

namespace fs = std::filesystem;

/// The study's table without what depends on the machine's speed or clock: cpu_s and finished_at.
std::string rows_of(const fs::path& study) {
  const TemporaryFolder folder;
  const fs::path csv = folder / "runs.csv";
  const Finished finished = repose({"export", study.string(), "--csv", csv.string()});
  EXPECT_EQ(finished.code, 0) << finished.err;
  std::istringstream stream(text_of(csv));
  std::vector<bool> keep;
  std::string rows;
  for (std::string line; std::getline(stream, line);) {
    bool quoted = false;  // a comma inside quotes is no end of a cell
    for (char& c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && quoted) c = ';';
    }
    std::istringstream cells(line);
    std::size_t at = 0;
    const bool header = keep.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++at) {
      if (header) keep.push_back(cell != "cpu_s" && cell != "finished_at");
      if (keep[at]) rows += cell + ",";
    }
    rows += "\n";
  }
  return rows;
}

std::string swept(const TemporaryFolder& folder, const std::string& name, const Json& json,
                  const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments = {"sweep", write_case(folder, json), "--out", (folder / name).string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Finished run = repose(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return rows_of(folder / name);
}

TEST(Sweep, StoresEveryRunOfTheDesign) {
  const TemporaryFolder folder;
  const fs::path study = folder / "study";
  const Finished run =
      repose({"sweep", write_case(folder, tiny_sweep(2)), "--out", study.string(), "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("planned"), 8);
  EXPECT_EQ(json.at("finished"), 8);
  EXPECT_EQ(json.at("left"), 0);
  EXPECT_EQ(json.at("outcomes").at("completed"), 8);
  EXPECT_TRUE(fs::exists(study / "study.sqlite"));
  EXPECT_EQ(Json::parse(text_of(study / "case.json")).at("sweep"), tiny_sweep(2).at("sweep"));
  EXPECT_GE(lines_with(run.err, "of 8 runs done"), 1) << run.err;

  const Finished status = repose({"status", study.string(), "--json"});
  EXPECT_EQ(Json::parse(status.out).at("done"), 8);
  EXPECT_EQ(Json::parse(status.out).at("failed"), 0);
  EXPECT_EQ(Json::parse(status.out).at("left"), 0);
}

TEST(Sweep, SecondCallRunsNothing) {
  const TemporaryFolder folder;
  const std::string before = swept(folder, "study", tiny_sweep());
  const Finished again =
      repose({"sweep", write_case(folder, tiny_sweep()), "--out", (folder / "study").string(), "--json"});
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(Json::parse(again.out).at("finished"), 0);
  EXPECT_EQ(rows_of(folder / "study"), before);
}

TEST(Sweep, OneAndTwoThreadsGiveTheSameBits) {
  const TemporaryFolder folder;
  EXPECT_EQ(swept(folder, "one", tiny_sweep(), {"--threads", "1"}),
            swept(folder, "two", tiny_sweep(), {"--threads", "2"}));
}

TEST(Sweep, SharedColumnsGiveTheSameBitsForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  Json json = tiny_sweep();
  json["test"]["shared_columns"] = {{"count", 2}};
  const std::string one = swept(folder, "one", json, {"--threads", "1"});
  EXPECT_EQ(one, swept(folder, "two", json, {"--threads", "2"}));
  EXPECT_NE(one, swept(folder, "own", tiny_sweep(), {"--threads", "2"}));
}

TEST(Sweep, ExtendedDesignRunsOnlyWhatIsNew) {
  const TemporaryFolder folder;
  swept(folder, "study", tiny_sweep(1));
  const Finished more =
      repose({"sweep", write_case(folder, tiny_sweep(2)), "--out", (folder / "study").string(), "--json"});
  EXPECT_EQ(Json::parse(more.out).at("present"), 4);
  EXPECT_EQ(Json::parse(more.out).at("finished"), 4);
}

/// Starts a sweep of runs long enough to be interrupted, and sends the signal once a run is stored.
Finished interrupted(const fs::path& study, const std::string& file, int signal) {
  Process sweep(REPOSE_PROGRAM, {"sweep", file, "--out", study.string(), "--threads", "1"});
  EXPECT_TRUE(eventually([&] {
    const Finished status = repose({"status", study.string(), "--json"});
    return status.code == 0 && Json::parse(status.out).at("done") >= 1;
  }));
  sweep.send(signal);
  return sweep.wait();
}

int done_of(const fs::path& study) {
  return Json::parse(repose({"status", study.string(), "--json"}).out).at("done");
}

constexpr int kReplicates = 3;  ///< of the sweeps that are interrupted
constexpr int kRuns = 4 * kReplicates;

/// The rows of the same sweep when nothing interrupts it.
const std::string& uninterrupted_rows() {
  static const std::string rows = [] {
    const TemporaryFolder folder;
    return swept(folder, "whole", tiny_sweep(kReplicates));
  }();
  return rows;
}

TEST(Sweep, AfterAKillItGoesOnAndTheRowsAreTheSame) {
  const TemporaryFolder folder;
  const Json json = tiny_sweep(kReplicates);
  const fs::path study = folder / "killed";
  const Finished killed = interrupted(study, write_case(folder, json), SIGKILL);
  EXPECT_EQ(killed.signal, SIGKILL);
  const int done = done_of(study);
  EXPECT_GE(done, 1);
  EXPECT_LT(done, kRuns) << "the sweep was to be killed half way";
  EXPECT_EQ(swept(folder, "killed", json), uninterrupted_rows());
}

TEST(Sweep, AfterCtrlCItGoesOnAndTheRowsAreTheSame) {
  const TemporaryFolder folder;
  const Json json = tiny_sweep(kReplicates);
  const fs::path study = folder / "stopped";
  const Finished stopped = interrupted(study, write_case(folder, json), SIGINT);
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_LT(done_of(study), kRuns) << "the sweep was to be stopped half way";
  EXPECT_EQ(swept(folder, "stopped", json), uninterrupted_rows());
}

TEST(Sweep, ShardsMergedAreTheWhole) {
  const TemporaryFolder folder;
  swept(folder, "a", tiny_sweep(), {"--shard", "1/2"});
  swept(folder, "b", tiny_sweep(), {"--shard", "2/2"});
  EXPECT_EQ(done_of(folder / "a") + done_of(folder / "b"), 4);
  const Finished merged = repose({"merge", (folder / "a").string(), (folder / "b").string(), "--into",
                                  (folder / "both").string(), "--json"});
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(Json::parse(merged.out).at("runs"), 4);
  EXPECT_EQ(rows_of(folder / "both"), swept(folder, "whole", tiny_sweep()));
}

TEST(Export, WritesToPipesAndLinksAndNeverOverItsStudy) {
  const TemporaryFolder folder;
  const std::string study = (folder / "study").string();
  swept(folder, "study", tiny_sweep());
  ASSERT_EQ(repose({"export", study, "--csv", (folder / "plain.csv").string()}).code, 0);
  const std::string plain = text_of(folder / "plain.csv");
  write_text(folder / "target.csv", "");
  fs::create_symlink("target.csv", folder / "link.csv");
  ASSERT_EQ(repose({"export", study, "--csv", (folder / "link.csv").string()}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(text_of(folder / "target.csv"), plain);
  const Finished out = repose({"export", study, "--csv", "/dev/stdout", "--quiet"});
  EXPECT_EQ(out.code, 0) << out.err;
  EXPECT_EQ(out.out, plain);
  const Finished over = repose({"export", study, "--csv", study + "/study.sqlite"});
  EXPECT_EQ(over.code, 2);
  EXPECT_EQ(done_of(folder / "study"), 4);
}

TEST(Sweep, RunsThatDoNotCompleteEndWithThreeAndTheRestIsDone) {
  const TemporaryFolder folder;
  Json json = tiny_sweep();
  json["sweep"] = {{"design", "full_factorial"},
                   {"factors", {{"/numerics/stage_time_limit_s", {0.002, 5.0}}}}};
  const fs::path study = folder / "study";
  const Finished run = repose({"sweep", write_case(folder, json), "--out", study.string(), "--json"});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(Json::parse(run.out).at("outcomes").at("completed"), 1) << run.out;
  EXPECT_EQ(Json::parse(run.out).at("outcomes").at("timed_out"), 1) << run.out;
  const Json status = Json::parse(repose({"status", study.string(), "--json"}).out);
  EXPECT_EQ(status.at("failed"), 1);
  EXPECT_NE(status.at("not_completed").at(0).at("reason"), "");
}

TEST(Sweep, EveryFaultOfTheDesignAndOptionsComesAtOnceAndNothingIsWritten) {
  const TemporaryFolder folder;
  Json json = tiny_sweep();
  json["sweep"]["design"] = "sobolev";
  json["sweep"]["factors"]["mu_x"] = {0.1};
  json["walls"]["poisson_ratio"] = 0.7;
  const fs::path study = folder / "study";
  const Finished run = repose({"sweep", write_case(folder, json), "--out", study.string(), "--threads", "0",
                               "--shard", "3/2", "--json"});
  EXPECT_EQ(run.code, 2);
  for (const std::string word : {"sobolev", "mu_x", "/walls/poisson_ratio", "--threads", "3/2"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  EXPECT_FALSE(fs::exists(study));
}

TEST(Sweep, AnotherCasesFolderIsRefused) {
  const TemporaryFolder folder;
  const std::string before = swept(folder, "study", tiny_sweep());
  Json other = tiny_sweep();
  other["particles"]["density_kg_m3"] = 3000;
  const Finished run = repose({"sweep", write_case(folder, other), "--out", (folder / "study").string()});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("density_kg_m3"), std::string::npos) << run.err;
  EXPECT_EQ(rows_of(folder / "study"), before);
}

TEST(Sweep, WhatIsNoStudyIsSaid) {
  const TemporaryFolder folder;
  const std::string nothing = (folder / "nothing").string();
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"status", nothing},
                                                    {"export", nothing, "--csv", (folder / "a.csv").string()},
                                                    {"merge", nothing, "--into", (folder / "b").string()},
                                                    {"fit", nothing},
                                                    {"report", nothing}}) {
    const Finished run = repose(arguments);
    EXPECT_EQ(run.code, 2) << arguments[0];
    EXPECT_NE(run.err.find(nothing), std::string::npos) << arguments[0] << ": " << run.err;
  }
  EXPECT_FALSE(fs::exists(folder / "a.csv"));
  EXPECT_FALSE(fs::exists(folder / "b"));
}

}  // namespace
}  // namespace repose::test
