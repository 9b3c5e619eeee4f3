#include "sweep/export.hpp"

#include <gtest/gtest.h>

#include "engine/base/csv.hpp"
#include "sweep/study.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

class ExportTest : public testing::Test {
 protected:
  CsvTable exported() const {
    export_csv(folder_ / "study", folder_ / "table.csv");
    Faults faults;
    CsvTable table = read_csv(folder_ / "table.csv", faults);
    faults.throw_if_any();
    return table;
  }
  void make(const Json& design, const repose::sweep::Run& run = fake_run) const {
    SweepOptions options = with_fake_run();
    options.run = run;
    run_sweep(document_of(case_with(design)), folder_ / "study", options);
  }
  test::TemporaryFolder folder_;
};

std::string cell(const CsvTable& table, std::size_t row, const std::string& column) {
  return table.rows.at(row).at(table.column(column).value());
}

TEST_F(ExportTest, ReadsBackBitForBit) {
  make(factorial());
  const CsvTable table = exported();
  const auto runs = open_study(folder_ / "study").store.runs();
  ASSERT_EQ(table.rows.size(), 12U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(cell(table, i, "run_key"), runs[i].run_key);
    EXPECT_EQ(parse_number(cell(table, i, "e_pp")), 0.3);
    EXPECT_EQ(parse_number(cell(table, i, "mu_s")), runs[i].mu_s);
    EXPECT_EQ(parse_number(cell(table, i, "mu_r")), runs[i].mu_r);
    EXPECT_EQ(parse_number(cell(table, i, "angle_deg")), runs[i].angle_deg);
    EXPECT_EQ(parse_number(cell(table, i, "angle_4_deg")), runs[i].angles_deg[3]);
    EXPECT_EQ(parse_number(cell(table, i, "bulk_density_kg_m3")), runs[i].bulk_density_kg_m3);
    EXPECT_EQ(cell(table, i, "replicate"), std::to_string(runs[i].replicate));
    EXPECT_EQ(cell(table, i, "seed"), std::to_string(runs[i].seed));
    EXPECT_EQ(cell(table, i, "outcome"), "completed");
  }
  EXPECT_FALSE(table.column("factors").has_value());
}

TEST_F(ExportTest, HasAColumnForEveryFactorFilledFromTheCaseWhereItWasNotVaried) {
  Json design = factorial(1);
  make(design);
  design["factors"] = {
      {"mu_s", {0.2}}, {"/particles/total_mass_kg", {0.02}}, {"/numerics/stiffness_scale", {0.5}}};
  make(design);
  const CsvTable table = exported();
  ASSERT_EQ(table.rows.size(), 7U);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool varied = !cell(table, i, "point").empty();  // runs of the first design have no point any more
    EXPECT_EQ(cell(table, i, "/particles/total_mass_kg"), varied ? "0.02" : "0.05");
    EXPECT_EQ(cell(table, i, "/numerics/stiffness_scale"), varied ? "0.5" : "");  // the case does not give it
  }
}

TEST_F(ExportTest, LeavesNoAngleForARunThatDidNotCompleteAndQuotesItsReason) {
  const std::string reason = "grew, \"exploded\"\nand left";
  make(factorial(1), [&](const Scene& scene, std::uint64_t seed, const RunOptions& options) {
    RunResult result = fake_run(scene, seed, options);
    result.outcome = Outcome::diverged;
    result.reason = reason;
    return result;
  });
  const CsvTable table = exported();
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(cell(table, 0, "outcome"), "diverged");
  EXPECT_EQ(cell(table, 0, "reason"), "grew, \"exploded\" and left");
  EXPECT_EQ(cell(table, 0, "angle_deg"), "");
  EXPECT_EQ(cell(table, 0, "angle_1_deg"), "");
  EXPECT_EQ(cell(table, 0, "mass_on_base_kg"), "0.04");
}

TEST_F(ExportTest, NamesWarningsInAColumnAndTheirTextsInAnother) {
  make(factorial(1), [](const Scene& scene, std::uint64_t seed, const RunOptions& options) {
    RunResult result = fake_run(scene, seed, options);
    result.warnings = {{"few_particles", "only 90, pour more"}, {"slow_opening", "0.1 m/s"}};
    return result;
  });
  const CsvTable table = exported();
  EXPECT_EQ(cell(table, 0, "warnings"), "few_particles slow_opening");
  EXPECT_EQ(cell(table, 0, "warning_details"), "few_particles: only 90, pour more | slow_opening: 0.1 m/s");
  EXPECT_EQ(cell(table, 0, "outcome"), "completed");
  const StudyStatus status = status_of(folder_ / "study");
  EXPECT_EQ(status.warnings.at("slow_opening").runs, 6);
  EXPECT_EQ(status.warnings.at("slow_opening").example, "0.1 m/s");
}

TEST_F(ExportTest, LeavesOutWhatALaterVersionHasMadeAgain) {
  make(factorial(1));
  Study study = open_study(folder_ / "study");
  StoredRun old = study.store.runs().front();
  old.run_key = "of an older version";
  old.finished_at = "2020-01-01T00:00:00Z";
  study.store.put(old);
  EXPECT_EQ(exported().rows.size(), 6U);
}

TEST_F(ExportTest, NamesAFileThatCannotBeWritten) {
  make(factorial(1));
  const auto file = folder_ / "no_folder" / "table.csv";
  EXPECT_TRUE(message_of([&] { export_csv(folder_ / "study", file); }).starts_with(file.string() + ": "));
}

}  // namespace
}  // namespace repose::sweep
