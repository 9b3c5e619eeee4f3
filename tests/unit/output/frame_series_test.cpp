#include "engine/output/heap_files.hpp"
#include "unit/output/output_fixture.hpp"
#include "unit/output/vtp_reader.hpp"

namespace repose {
namespace {

using FrameSeriesTest = OutputTest;

struct PvdEntry {
  double time = 0.0;
  std::string file;
};

std::vector<PvdEntry> read_pvd(const std::filesystem::path& file) {
  const XmlElement root = XmlReader(read_text(file)).document();
  if (root.name != "VTKFile" || root.attributes.at("type") != "Collection")
    throw std::runtime_error("header");
  std::vector<PvdEntry> entries;
  for (const XmlElement& e : root.child("Collection").children) {
    if (e.name != "DataSet") throw std::runtime_error("a " + e.name);
    entries.push_back({std::stod(e.attributes.at("timestep")), e.attributes.at("file")});
  }
  return entries;
}

HeapSnapshot at_time(double time) {
  HeapSnapshot heap = moving_snapshot();
  heap.time = time;
  heap.bodies[0].position.x() = time;
  return heap;
}

TEST_F(FrameSeriesTest, IsCompleteAfterEveryFrame) {
  FrameSeries series(folder_, "film");
  for (int k = 0; k < 4; ++k) {
    series.add(at_time(0.1 * k));
    for (const char* kind : {"film_spheres.pvd", "film_bodies.pvd", "film_walls.pvd"}) {
      const std::vector<PvdEntry> entries = read_pvd(folder_ / kind);
      ASSERT_EQ(entries.size(), static_cast<std::size_t>(k + 1)) << kind;
      for (int f = 0; f <= k; ++f) {
        const PvdEntry& entry = entries[static_cast<std::size_t>(f)];
        EXPECT_NEAR(entry.time, 0.1 * f, 1e-9);
        EXPECT_NO_THROW(read_vtp(folder_ / entry.file)) << entry.file;
      }
    }
  }
  EXPECT_EQ(series.size(), 4U);
}

TEST_F(FrameSeriesTest, EachFrameHoldsItsOwnInstant) {
  FrameSeries series(folder_, "film");
  for (int k = 0; k < 3; ++k) series.add(at_time(0.25 * k));
  for (const PvdEntry& entry : read_pvd(folder_ / "film_bodies.pvd")) {
    EXPECT_EQ(read_vtp(folder_ / entry.file).points.values.at(0), entry.time);
  }
}

TEST_F(FrameSeriesTest, RetainKeepsTheChosenFramesAndRemovesTheOthersFiles) {
  FrameSeries series(folder_, "film");
  std::vector<std::string> before;
  for (int k = 0; k < 5; ++k) series.add(at_time(0.1 * k));
  for (const PvdEntry& entry : read_pvd(folder_ / "film_spheres.pvd")) before.push_back(entry.file);
  series.retain({1, 0, 0, 1, 1});
  const std::vector<PvdEntry> after = read_pvd(folder_ / "film_spheres.pvd");
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[1].file, before[3]);
  EXPECT_NEAR(after[1].time, 0.3, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(folder_ / before[0]));
  EXPECT_FALSE(std::filesystem::exists(folder_ / before[1]));
  series.add(at_time(0.9));
  EXPECT_EQ(read_pvd(folder_ / "film_spheres.pvd").size(), 4U);
  for (const PvdEntry& entry : read_pvd(folder_ / "film_spheres.pvd")) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / entry.file)) << entry.file;
  }
}

TEST_F(FrameSeriesTest, ANameWithMarkupCharactersStaysWellFormed) {
  FrameSeries series(folder_, "a & b <c>");
  series.add(at_time(0.0));
  const std::vector<PvdEntry> entries = read_pvd(folder_ / "a & b <c>_spheres.pvd");
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_NO_THROW(read_vtp(folder_ / entries[0].file));
}

TEST_F(FrameSeriesTest, LeavesNoHalfWrittenFiles) {
  FrameSeries series(folder_, "film");
  series.add(at_time(0.0));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

}  // namespace
}  // namespace repose
