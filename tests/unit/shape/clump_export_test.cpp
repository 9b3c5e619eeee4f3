#include "engine/shape/clump_export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "engine/base/input_error.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

Clump pair() {
  return {.name = "pair",
          .spheres = {{Vec3(0.001, 0.002, 0.003), 0.004}, {Vec3(-0.005, 0.006, -0.007), 0.008}},
          .volume = 1e-6,
          .inertia = Vec3(1e-11, 2e-11, 2.5e-11)};
}

/// Numbers of every line that is not a comment.
std::vector<std::vector<double>> numbers_of(const std::string& text, char separator) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, separator);) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ClumpExport, LiggghtsGetsOneLineASphereAndTheMassProperties) {
  const std::string text = liggghts_text(pair(), 3886.0);
  const auto rows = numbers_of(text, ' ');
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1], (std::vector<double>{-0.005, 0.006, -0.007, 0.008}));
  EXPECT_THAT(text, HasSubstr("nspheres 2"));
  EXPECT_THAT(text, HasSubstr("mass 3.886000000e-03"));
  EXPECT_THAT(text, HasSubstr("inertia_tensor 3.886000000e-08 0 0 7.772000000e-08 0 9.715000000e-08"));
}

TEST(ClumpExport, YadeGetsTheClumpsNumberInTheFifthColumn) {
  const auto rows = numbers_of(yade_text(pair()), ' ');
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], (std::vector<double>{0.001, 0.002, 0.003, 0.004, 0.0}));
}

TEST(ClumpExport, MercuryGetsItsFourFiles) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "repose_mercury_test";
  write_mercury(folder, pair(), 1000.0);
  EXPECT_EQ(numbers_of(content(folder / "pair/Clump/Clump.txt"), ',')[1],
            (std::vector<double>{-0.005, 0.006, -0.007, 0.008}));
  EXPECT_DOUBLE_EQ(numbers_of(content(folder / "pair/Inertia/Mass.txt"), ',')[0][0], 1e-3);
  const auto tensor = numbers_of(content(folder / "pair/Inertia/TOI.txt"), ',');
  ASSERT_EQ(tensor.size(), 3u);
  EXPECT_DOUBLE_EQ(tensor[1][1], 2e-8);
  EXPECT_EQ(tensor[2][0], 0.0);
  EXPECT_EQ(numbers_of(content(folder / "pair/Inertia/PD.txt"), ',').size(), 3u);
  std::filesystem::remove_all(folder);
}

TEST(ClumpExport, VtkHoldsPointsAndRadii) {
  const std::string text = vtk_text(pair());
  EXPECT_THAT(text, HasSubstr("POINTS 2 double\n1.000000000e-03 2.000000000e-03 3.000000000e-03\n"));
  EXPECT_THAT(text,
              HasSubstr("SCALARS radius double 1\nLOOKUP_TABLE default\n4.000000000e-03\n8.000000000e-03\n"));
}

TEST(ClumpExport, AFileThatCannotBeWrittenIsSaid) {
  EXPECT_THROW(write_text(std::filesystem::temp_directory_path(), "text"), InputError);
}

}  // namespace
}  // namespace repose
