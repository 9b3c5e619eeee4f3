#include "engine/shape/scan_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/base/input_error.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

class ScanTableFile : public ::testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      (std::string("repose_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  void TearDown() override { std::filesystem::remove(file_); }

  std::string faults_of(const std::string& text) {
    std::ofstream(file_) << text;
    try {
      read_scan_table(file_);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
};

TEST(ScanTable, GivesTheFiguresOfTheArticle) {
  const ScanTable table = read_scan_table("cases/table1_particles.csv");
  ASSERT_EQ(table.particles.size(), 36u);
  // The article prints 0.718, 0.963 (adjusted R²) and 0.776; more digits recomputed by hand from its Table 1.
  EXPECT_NEAR(table.slope, 0.7183, 5e-5);
  EXPECT_NEAR(table.intercept_mm2, 13.016, 5e-4);
  EXPECT_NEAR(table.r_squared, 0.9643, 5e-5);
  EXPECT_NEAR(table.adjusted_r_squared, 0.9633, 5e-5);
  EXPECT_NEAR(table.mean_sphericity, 0.776, 5e-4);
  EXPECT_NEAR(table.mean_recomputed_sphericity, 0.7766, 5e-5);
  ASSERT_EQ(table.size_classes.size(), 4u);
  const std::size_t counts[] = {16, 9, 8, 3};  // Table 3
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(table.size_classes[i].volume_min_mm3, 100.0 * static_cast<double>(i + 1));
    EXPECT_EQ(table.size_classes[i].count, counts[i]);
  }
  EXPECT_NEAR(table.size_classes[0].percent, 44.44, 0.005);
}

TEST(ScanTable, FindsThatTheArticleTookPiAs314) {
  const ScanTable table = read_scan_table("cases/table1_particles.csv");
  EXPECT_EQ(table.pi_of_table, 3.14);
  // Row 20: (36 · 3.14 · 265.3²)^{1/3} = 199.634, printed 199.65; the volume has one decimal only.
  const auto row = std::find_if(table.inconsistent.begin(), table.inconsistent.end(),
                                [](const InconsistentValue& value) { return value.name == "20"; });
  ASSERT_NE(row, table.inconsistent.end());
  EXPECT_EQ(row->column, "equivalent_sphere_area_mm2");
  EXPECT_NEAR(row->recomputed, 199.634, 5e-4);
  EXPECT_TRUE(row->within_rounding);
}

TEST_F(ScanTableFile, OfOtherParticlesNeedsOnlyAreaAndVolume) {
  // Cubes of side 1, 2, 3 and 4 cm: Ψ = (π/6)^{1/3}, and the equivalent area is Ψ times the area.
  std::ofstream(file_)
      << "volume_mm3,surface_area_mm2,remark\n1000,600,a\n8000,2400,b\n27000,5400,c\n64000,9600,d\n";
  const ScanTable table = read_scan_table(file_);
  const double sphericity = std::cbrt(kPi / 6.0);
  EXPECT_NEAR(table.mean_sphericity, sphericity, 1e-14);
  EXPECT_NEAR(table.slope, sphericity, 1e-14);
  EXPECT_NEAR(table.intercept_mm2, 0.0, 1e-10);
  EXPECT_NEAR(table.r_squared, 1.0, 1e-14);
  EXPECT_TRUE(table.inconsistent.empty());
  EXPECT_EQ(table.particles[2].name, "3");
  EXPECT_LE(table.size_classes.size(), 6u);
  std::size_t sorted = 0;
  for (const SizeHistogramClass& size : table.size_classes) sorted += size.count;
  EXPECT_EQ(sorted, 4u);
  EXPECT_EQ(read_scan_table(file_, {.class_width_mm3 = 10000.0}).size_classes.size(), 7u);
}

TEST_F(ScanTableFile, NamesAWrongRow) {
  std::ofstream(file_) << "no,volume_mm3,surface_area_mm2,sphericity\n"
                          "a,1000,600,0.806\nb,8000,2400,0.860\nc,27000,5400,0.806\n";
  const ScanTable table = read_scan_table(file_);
  ASSERT_EQ(table.inconsistent.size(), 1u);
  EXPECT_EQ(table.inconsistent[0].name, "b");
  EXPECT_EQ(table.inconsistent[0].line, 3);
  EXPECT_FALSE(table.inconsistent[0].within_rounding);
}

TEST_F(ScanTableFile, NamesEveryFaultWithItsLine) {
  const std::string faults = faults_of(
      "no,volume_mm3,surface_area_mm2\n1,-5,600\n2,8000,many\n# note\n2,27000,5400\n4,64000,96\n5,8000,\n");
  EXPECT_THAT(faults, HasSubstr("line 2 = volume_mm3 '-5': must be a number > 0"));
  EXPECT_THAT(faults, HasSubstr("line 3 = surface_area_mm2 'many': must be a number > 0"));
  EXPECT_THAT(faults, HasSubstr("line 5 = 2: every particle needs a number of its own"));
  EXPECT_THAT(faults, HasSubstr("line 6 = 80.600: no body has a sphericity above 1"));
  EXPECT_THAT(faults, HasSubstr("line 7 = surface_area_mm2 '': must be a number > 0"));
}

TEST_F(ScanTableFile, RefusesATableWithoutALine) {
  EXPECT_THAT(faults_of("a,b\n1,2\n"), HasSubstr("volume_mm3: this column is missing"));
  EXPECT_THAT(faults_of("a,b\n1,2\n"), HasSubstr("surface_area_mm2: this column is missing"));
  EXPECT_THAT(faults_of("volume_mm3,surface_area_mm2\n1000,600\n8000,2400\n"), HasSubstr("at least three"));
  EXPECT_THAT(faults_of("volume_mm3,surface_area_mm2\n1000,600\n1000,600\n900,600\n"),
              HasSubstr("all surface areas"));
  EXPECT_THROW(read_scan_table("no_such_table.csv"), InputError);
}

TEST_F(ScanTableFile, AVolumeOnABoundaryBelongsToTheClassThatItBegins) {
  std::ofstream(file_) << "volume_mm3,surface_area_mm2\n0.1,2\n0.2,3\n0.3,4\n0.6,5\n0.7,6\n";
  const ScanTable table = read_scan_table(file_, {.class_width_mm3 = 0.1});
  ASSERT_EQ(table.size_classes.size(), 7u);
  const std::size_t counts[] = {1, 1, 1, 0, 0, 1, 1};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(table.size_classes[i].count, counts[i]) << i;
}

TEST_F(ScanTableFile, EqualVolumesGetAClassOfTheirOwnSize) {
  std::ofstream(file_) << "volume_mm3,surface_area_mm2\n250,300\n250,310\n250,320\n";
  const ScanTable table = read_scan_table(file_);
  ASSERT_EQ(table.size_classes.size(), 1u);
  EXPECT_DOUBLE_EQ(table.size_classes[0].volume_min_mm3, 250.0);
  EXPECT_DOUBLE_EQ(table.size_classes[0].volume_max_mm3, 300.0);  // 50 is the next of 1, 2, 5 × 10^k to 25
  EXPECT_EQ(table.size_classes[0].count, 3u);
}

TEST_F(ScanTableFile, RefusesMoreClassesThanAnybodyReads) {
  std::ofstream(file_) << "volume_mm3,surface_area_mm2\n100,300\n200,310\n300,320\n";
  EXPECT_EQ(read_scan_table(file_, {.class_width_mm3 = 0.25}).size_classes.size(), 801u);
  try {
    read_scan_table(file_, {.class_width_mm3 = 1e-6});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("class width 1e-06 mm3: makes 200000001 size classes"));
  }
}

TEST_F(ScanTableFile, RefusesAPrintedSphericityAboveOne) {
  EXPECT_THAT(
      faults_of("volume_mm3,surface_area_mm2,sphericity\n1000,600,80.6\n8000,2400,0.806\n27000,5400,0.8\n"),
      HasSubstr("line 2 = sphericity 80.6: no body has a sphericity above 1"));
}

}  // namespace
}  // namespace repose
