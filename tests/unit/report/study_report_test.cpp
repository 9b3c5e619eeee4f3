#include <gtest/gtest.h>

#include "unit/report/report_fixture.hpp"

namespace repose::report {
namespace {

using test::count_of;
using test::full_report;
using test::report_of;
using test::table;
using test::TemporaryFolder;

std::string written(const ReportData& data, const TemporaryFolder& folder) {
  const std::filesystem::path page = write_report(folder.path() / "new" / "study", data);
  EXPECT_EQ(page, folder.path() / "new" / "study" / "report.html");
  return contents_of(page);
}

TEST(StudyReport, IsOnePageThatNeedsNoOtherFile) {
  const TemporaryFolder folder;
  ReportData data = full_report();
  data.inversion = fit::invert(*data.law, {.angle = 35.0, .sigma = 1.0});
  std::ofstream(folder.path() / "heap.png") << "not looked into";
  data.heaps = {{folder.path() / "heap.png", "The heap of the lowest angle"}};
  const std::string page = written(data, folder);
  EXPECT_EQ(count_of(page, "<img "), 3);
  EXPECT_EQ(count_of(page, "src=\"data:image/svg+xml;base64,"), 2);
  EXPECT_EQ(count_of(page, "src=\"data:image/png;base64,"), 1);
  EXPECT_EQ(count_of(page, "src="), 3);
  EXPECT_EQ(count_of(page, "href="), 0);
  EXPECT_EQ(count_of(page, "http"), 0);
  EXPECT_EQ(count_of(page, "The heap of the lowest angle"), 2);  // caption and alternative text
  for (const char* heading : {"<h2>The equation", "<h2>Heaps", "<h2>Runs"})
    EXPECT_EQ(count_of(page, heading), 1) << heading;
}

TEST(StudyReport, DrawsItsChartsWithGnuplot) {
  const TemporaryFolder folder;
  ReportData data = full_report();
  data.inversion = fit::invert(*data.law, {.angle = 35.0, .sigma = 1.0, .mu_r = 0.1});
  write_report(folder.path(), data);
  const std::string plane = contents_of(folder.path() / "level_set.svg");
  EXPECT_TRUE(plane.starts_with("<?xml"));
  EXPECT_EQ(count_of(plane, "</svg>"), 1);
  EXPECT_GE(count_of(plane, "35° ± 1°"), 1);
  // Twelve pairs were simulated; the mean angle of one of them is written at its point.
  double sum = 0.0;
  for (const RunRow& run : data.runs) {
    if (run.observation.mu_s == 0.4 && run.observation.mu_r == 0.1) sum += run.observation.angle / 3.0;
  }
  char mean[16];
  std::snprintf(mean, sizeof mean, "%.1f", sum);
  EXPECT_GE(count_of(plane, mean), 1);
  EXPECT_EQ(count_of(contents_of(folder.path() / "predicted_simulated.svg"), "</svg>"), 1);
}

TEST(StudyReport, HoldsAllTextsAsTextAndNotAsMarkup) {
  const TemporaryFolder folder;
  ReportData data = full_report();
  const std::string attack = "<script>alert(1)</script>";
  data.title = data.made_by = data.inversion_reason = attack;
  data.runs[0].observation.label = attack;
  data.runs[1].outcome = attack;
  data.inputs = {{attack, {{attack, attack}}}};
  data.cost = {{attack, attack}};
  std::ofstream(folder.path() / "heap.png") << "x";
  data.heaps = {{folder.path() / "heap.png", attack}};
  const std::string page = written(data, folder);
  EXPECT_EQ(count_of(page, "<script"), 0);
  EXPECT_EQ(count_of(page, "&lt;script&gt;"), 13);
}

TEST(StudyReport, ListsEveryRunAndWhyItIsLeftOut) {
  const TemporaryFolder folder;
  std::vector<fit::Observation> rows = table({0.3}, {0.05, 0.1, 0.2});
  rows[2].exclusion = "no_heap: everything rolled off";
  rows[5].mu_s = 0.0;
  const std::string page = written(report_of(rows), folder);
  for (const fit::Observation& row : rows)
    EXPECT_EQ(count_of(page, "<td>" + row.label + "</td>"), 1) << row.label;
  EXPECT_EQ(count_of(page, "<tr class=\"left-out\">"), 2);
  EXPECT_EQ(count_of(page, "<td>no_heap: everything rolled off</td>"), 1);
  EXPECT_EQ(count_of(page, "<td>completed; mu_s = 0: a power law cannot take a factor at 0</td>"), 1);
}

TEST(StudyReport, NamesTheWarningsOfRunsAndHowManyCarryThem) {
  const TemporaryFolder folder;
  ReportData data = full_report();
  EXPECT_EQ(count_of(written(data, folder), "<h2>Warnings</h2>"), 0);
  data.runs[3].warnings = "few_particles coarse_step";
  data.warnings = {{"coarse_step", 7, "a step of 2 < 3"}};
  const std::string page = written(data, folder);
  EXPECT_EQ(count_of(page, "<h2>Warnings</h2>"), 1);
  EXPECT_EQ(count_of(page, "<td>completed; warnings: few_particles coarse_step</td>"), 1);
  EXPECT_EQ(count_of(page, "<td>coarse_step</td><td class=\"number\">7</td><td>a step of 2 &lt; 3</td>"), 1);
}

TEST(StudyReport, SaysWhatTheEdgeOfTheBaseDoesToTheHeaps) {
  const TemporaryFolder folder;
  ReportData data = full_report();
  data.edge = "3 of 36 heaps reach the base's edge";
  EXPECT_EQ(count_of(written(data, folder), "<p>" + typeset(data.edge) + "</p>"), 1);
}

TEST(StudyReport, FoldsALongTableOfRuns) {
  const TemporaryFolder folder;
  EXPECT_EQ(count_of(written(report_of(table({0.3}, {0.05, 0.1, 0.2})), folder), "<details>"), 0);
  EXPECT_EQ(count_of(written(report_of(table({0.1, 0.2, 0.3, 0.4}, {0.05, 0.1, 0.2})), folder), "<details>"),
            1);
}

TEST(StudyReport, SaysWhyThereIsNoFitOrNoAnswer) {
  const TemporaryFolder folder;
  ReportData data;
  data.title = "Too small";
  data.law_reason = "too few points: 2 distinct points";
  data.runs = {{table({0.3}, {0.1}).front(), "completed", std::nullopt}};
  std::string page = written(data, folder);
  EXPECT_EQ(count_of(page, "too few points: 2 distinct points"), 1);
  EXPECT_EQ(count_of(page, "<h2>The equation"), 0);

  data = full_report();
  data.inversion_reason = "angle = 60 deg cannot be reached";
  page = written(data, folder);
  EXPECT_EQ(count_of(page, typeset("angle = 60 deg cannot be reached")), 1);
  EXPECT_EQ(count_of(page, "<img "), 2);
}

TEST(StudyReport, DrawsALineWhereOneFrictionWasSwept) {
  const TemporaryFolder folder;
  ReportData data = report_of(table({0.3}, {0.1}));
  data.inversion = fit::invert(*data.law, {.angle = 33.0, .sigma = 0.5});
  const std::string page = written(data, folder);
  EXPECT_EQ(count_of(page, "Line: the equation."), 1);
  EXPECT_EQ(count_of(contents_of(folder.path() / "new/study/level_set.svg"), "</svg>"), 1);
}

TEST(StudyReport, NeedsAFolderThatCanBeWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  EXPECT_ANY_THROW(write_report(folder.path() / "file", full_report()));
}

}  // namespace
}  // namespace repose::report
