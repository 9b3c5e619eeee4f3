#include <sstream>

#include "engine/output/heap_files.hpp"
#include "unit/output/output_fixture.hpp"
#include "unit/output/vtp_reader.hpp"

namespace repose {
namespace {

using HeapDump = OutputTest;

/// A LAMMPS text dump of one frame, read line by line.
struct DumpContent {
  long step = -1;
  std::array<double, 6> box{};
  std::vector<std::string> columns;
  std::vector<std::vector<double>> atoms;
  [[nodiscard]] double value(std::size_t atom, const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) throw std::runtime_error("no column " + column);
    return atoms.at(atom).at(static_cast<std::size_t>(found - columns.begin()));
  }
};

DumpContent read_dump(const std::filesystem::path& file) {
  std::istringstream stream(read_text(file));
  const auto line = [&] {
    std::string text;
    if (!std::getline(stream, text)) throw std::runtime_error("file ends early");
    return text;
  };
  const auto expect = [](const std::string& found, const std::string& wanted) {
    if (found != wanted) throw std::runtime_error("'" + found + "' is not '" + wanted + "'");
  };
  DumpContent dump;
  expect(line(), "ITEM: TIMESTEP");
  dump.step = std::stol(line());
  expect(line(), "ITEM: NUMBER OF ATOMS");
  const std::size_t count = std::stoul(line());
  expect(line(), "ITEM: BOX BOUNDS ff ff ff");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::istringstream(line()) >> dump.box[2 * axis] >> dump.box[2 * axis + 1];
  }
  std::istringstream header(line());
  std::string word;
  header >> word;
  expect(word, "ITEM:");
  header >> word;
  expect(word, "ATOMS");
  while (header >> word) dump.columns.push_back(word);
  for (std::size_t k = 0; k < count; ++k) {
    std::istringstream row(line());
    dump.atoms.emplace_back();
    double number = 0.0;
    while (row >> number) dump.atoms.back().push_back(number);
    if (dump.atoms.back().size() != dump.columns.size()) throw std::runtime_error("cells of a row");
  }
  std::string rest;
  if (std::getline(stream, rest)) throw std::runtime_error("text after the last atom");
  return dump;
}

TEST_F(HeapDump, HasTheColumnsThatOvitoMapsByName) {
  write_dump(moving_snapshot(), folder_ / "heap.dump", 0);
  const DumpContent dump = read_dump(folder_ / "heap.dump");
  const std::vector<std::string> expected{"id", "type", "mol", "x", "y", "z", "radius", "vx", "vy", "vz"};
  EXPECT_EQ(dump.columns, expected);
}

TEST_F(HeapDump, HasOneAtomPerSphereAndTheBodyAsItsMolecule) {
  const HeapSnapshot heap = moving_snapshot();
  write_dump(heap, folder_ / "heap.dump", 123456);
  const DumpContent dump = read_dump(folder_ / "heap.dump");
  EXPECT_EQ(dump.step, 123456);
  ASSERT_EQ(dump.atoms.size(), heap.spheres.size());
  for (std::size_t s = 0; s < heap.spheres.size(); ++s) {
    const SphereSnapshot& sphere = heap.spheres[s];
    EXPECT_EQ(dump.value(s, "id"), static_cast<double>(s + 1));
    EXPECT_EQ(dump.value(s, "mol"), sphere.body + 1);
    EXPECT_EQ(dump.value(s, "type"), heap.bodies[static_cast<std::size_t>(sphere.body)].shape + 1);
    // Nine digits of lengths; six of velocities, which are below 10 m/s.
    EXPECT_NEAR(dump.value(s, "x"), sphere.centre.x(), 1e-9 * 0.06);
    EXPECT_NEAR(dump.value(s, "y"), sphere.centre.y(), 1e-9 * 0.06);
    EXPECT_NEAR(dump.value(s, "z"), sphere.centre.z(), 1e-9 * 0.06);
    EXPECT_NEAR(dump.value(s, "radius"), sphere.radius, 2e-9 * 0.003);
    const Vec3 velocity = velocity_of(heap, sphere);
    EXPECT_NEAR(dump.value(s, "vx"), velocity.x(), 1e-5);
    EXPECT_NEAR(dump.value(s, "vy"), velocity.y(), 1e-5);
    EXPECT_NEAR(dump.value(s, "vz"), velocity.z(), 1e-5);
  }
}

TEST_F(HeapDump, TheBoxHoldsEverySphere) {
  const HeapSnapshot heap = moving_snapshot();
  write_dump(heap, folder_ / "heap.dump", 0);
  const DumpContent dump = read_dump(folder_ / "heap.dump");
  for (const SphereSnapshot& sphere : heap.spheres) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = sphere.centre[static_cast<Eigen::Index>(axis)];
      EXPECT_LE(dump.box[2 * axis], c - sphere.radius + 1e-10);
      EXPECT_GE(dump.box[2 * axis + 1], c + sphere.radius - 1e-10);
    }
  }
}

TEST_F(HeapDump, AnEmptyHeapHasNoAtomsAndABox) {
  write_dump({}, folder_ / "empty.dump", 7);
  const DumpContent dump = read_dump(folder_ / "empty.dump");
  EXPECT_TRUE(dump.atoms.empty());
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(dump.box[2 * axis], dump.box[2 * axis + 1]);
}

TEST_F(HeapDump, NamesTheFileThatCannotBeWritten) {
  const std::filesystem::path file = folder_ / "missing" / "heap.dump";
  try {
    write_dump(moving_snapshot(), file, 0);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace repose
