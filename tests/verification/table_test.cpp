#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "verification/table/row.hpp"

namespace repose::verification {
namespace {

struct Part {
  const char* name;
  Rows (*rows)();
};

/// The tests that stand in table.md, which is what `tools/verify --markdown` printed.
const std::set<std::string>& printed() {
  static const std::set<std::string> tests = [] {
    std::ifstream file("tests/verification/table.md");
    std::set<std::string> names;
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("| ")) names.insert(line.substr(2, line.find(" |", 2) - 2));
    return names;
  }();
  return tests;
}

/// Every row of the verification table meets its bar, and stands on the page that shows it.
class VerificationTable : public ::testing::TestWithParam<Part> {};

TEST_P(VerificationTable, MeetsItsBars) {
  const Rows rows = GetParam().rows();
  ASSERT_FALSE(rows.empty());
  for (const Row& row : rows)
    EXPECT_TRUE(row.passed()) << row.test << ": theory " << row.theory << ", result " << row.result
                              << ", error " << row.error << ", bar " << row.bar;
  for (const Row& row : rows) EXPECT_TRUE(printed().contains(row.test)) << row.test << " is not in table.md";
}

INSTANTIATE_TEST_SUITE_P(
    Rows, VerificationTable,
    ::testing::Values(Part{"NormalImpacts", normal_impact_rows}, Part{"ObliqueImpacts", oblique_impact_rows},
                      Part{"Restitution", restitution_rows}, Part{"MindlinCycles", cycle_rows},
                      Part{"SlidingAndRolling", sliding_and_rolling_rows}, Part{"Bounces", bounce_rows},
                      Part{"Integrators", integrator_rows}, Part{"Rotation", rotation_rows},
                      Part{"Clumps", clump_rows}, Part{"HeapAngles", heap_angle_rows}),
    [](const ::testing::TestParamInfo<Part>& info) { return info.param.name; });

TEST(VerificationRow, MissesItsBarWhereTheErrorIsNoNumber) {
  Row row;
  row.bar = 1.0;
  row.error = std::nan("");
  EXPECT_FALSE(row.passed());
}

TEST(VerificationRow, KeepsAnErrorThatIsNoNumberAndMissesWithoutAnyPoint) {
  Worst worst("a", "b", 0.1);
  worst.add(1.0, 1.01);
  worst.add(1.0, std::nan(""));
  worst.add(1.0, 1.02);
  EXPECT_FALSE(worst.row().passed());
  EXPECT_FALSE(Worst("a", "b", 0.1).row().passed());
}

TEST(VerificationRow, HoldsTheWorstPoint) {
  Worst worst("a", "b", 0.1);
  worst.add(1.0, 1.01);
  worst.add(2.0, 2.3);
  worst.add(4.0, 4.04);
  EXPECT_EQ(worst.row().theory, 2.0);
  EXPECT_NEAR(worst.row().error, 0.15, 1e-12);
  EXPECT_FALSE(worst.row().passed());
}

}  // namespace
}  // namespace repose::verification
