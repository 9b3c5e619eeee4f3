// One study in which each run fails in another way: every outcome and warning, with its words, stands in the
// sweep's table, in what `status` says and in the report; `simulate` says the same.

#include <gtest/gtest.h>

#include <map>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

/// What a run is given, and the outcome and a warning that it must have.
struct Way {
  const char* row;  ///< of the design's table
  const char* outcome;
  const char* warning;  ///< may be empty
};

constexpr const char* kColumns =
    "/numerics/time_step_fraction,/numerics/stiffness_scale,/particles/total_mass_kg,/test/opening_speed_m_s,"
    "/numerics/stage_time_limit_s,mu_s";
const std::vector<Way> kWays{{"0.2,1,0.025,1,5,0.5", "completed", "flat_heap"},
                             {"0.2,1,0.025,1,5,1.5", "completed", "high_friction"},
                             {"0.2,1,0.025,0.1,5,0.5", "completed", "slow_opening"},
                             {"1e-9,1,0.025,1,5,0.5", "too_long", ""},
                             {"100,1,0.025,1,5,0.5", "escaped", ""},
                             {"0.5,1,0.025,1,5,0.5", "unstable", "energy_error"},
                             {"0.2,0.01,0.025,1,5,0.5", "overlapping", "soft_contacts"},
                             {"0.2,1,0.2,1,5,0.5", "overfull", ""},
                             {"0.2,1,0.001,1,5,0.5", "no_heap", ""},
                             {"0.2,1,0.025,1,0.002,0.5", "timed_out", ""}};

class Outcomes : public testing::Test {
 protected:
  void SetUp() override {
    std::string table = std::string(kColumns) + "\n";
    for (const Way& way : kWays) table += std::string(way.row) + "\n";
    write_text(folder_ / "ways.csv", table);
    Json json = tiny_case();
    json["sweep"] = {{"design", "table"}, {"table", "ways.csv"}, {"seed", 1}};
    case_ = write_case(folder_, json);
    study_ = (folder_ / "study").string();
    const Finished run = repose({"sweep", case_, "--out", study_, "--quiet"});
    ASSERT_EQ(run.code, 3) << run.err;
  }
  TemporaryFolder folder_;
  std::string case_, study_;
};

TEST_F(Outcomes, OfEveryKindStandInTheTableInStatusAndInTheReport) {
  const std::string csv = (folder_ / "runs.csv").string();
  ASSERT_EQ(repose({"export", study_, "--csv", csv}).code, 0);
  const std::string table = text_of(csv);
  const Json status = Json::parse(repose({"status", study_, "--json"}).out);
  EXPECT_EQ(repose({"report", study_}).code, 2) << "two points make no equation, but a page";
  const std::string page = text_of(std::filesystem::path(study_) / "report.html");

  std::map<std::string, int> expected;
  for (const Way& way : kWays) {
    ++expected[way.outcome];
    EXPECT_GE(lines_with(table, way.outcome), 1) << way.row;
    EXPECT_NE(page.find(way.outcome), std::string::npos) << way.row;
    if (*way.warning == '\0') continue;
    EXPECT_GE(lines_with(table, way.warning), 1) << way.row;
    EXPECT_NE(page.find(way.warning), std::string::npos) << way.row;
  }
  for (const auto& [outcome, count] : expected) EXPECT_EQ(status.at("outcomes").at(outcome), count) << status;
  EXPECT_EQ(status.at("failed").get<std::size_t>(), kWays.size() - 3);
  for (const Json& run : status.at("not_completed")) EXPECT_NE(run.at("reason"), "") << run;
  EXPECT_NE(page.find("s edge: what comes down"), std::string::npos) << "how many heaps it cuts";
}

TEST_F(Outcomes, OfOneRunAreTheSameInSimulateAndLeaveOpenWhatWasNotMeasured) {
  const Finished run =
      repose({"simulate", case_, "--json", "--quiet", "--set", "/numerics/time_step_fraction=1e-9"});
  EXPECT_EQ(run.code, 3);
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("outcome"), "too_long");
  EXPECT_NE(json.at("reason").get<std::string>().find("larger step"), std::string::npos) << json;
  EXPECT_TRUE(json.at("angle_of_repose_deg").is_null());
  for (const auto& [name, value] : json.at("responses").items()) EXPECT_TRUE(value.is_null()) << name;
}

}  // namespace
}  // namespace repose::test
