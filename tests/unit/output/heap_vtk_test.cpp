#include <cmath>

#include "engine/output/heap_files.hpp"
#include "unit/output/output_fixture.hpp"
#include "unit/output/vtp_reader.hpp"

namespace repose {
namespace {

using HeapVtk = OutputTest;

/// Component c of tuple k.
double value(const VtpArray& array, std::size_t k, std::size_t c = 0) {
  return array.values.at(k * static_cast<std::size_t>(array.components) + c);
}

void expect_vector(const VtpArray& array, std::size_t k, const Vec3& expected) {
  ASSERT_EQ(array.components, 3);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(value(array, k, c), expected[static_cast<Eigen::Index>(c)]) << "tuple " << k;
  }
}

TEST_F(HeapVtk, NamesTheThreeFilesItWrites) {
  const std::vector<std::filesystem::path> files = write_vtk(moving_snapshot(), folder_, "heap");
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0], folder_ / "heap_spheres.vtp");
  EXPECT_EQ(files[1], folder_ / "heap_bodies.vtp");
  EXPECT_EQ(files[2], folder_ / "heap_walls.vtp");
  for (const auto& file : files) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST_F(HeapVtk, KeepsEveryNumberOfTheSpheresBitForBit) {
  const HeapSnapshot heap = moving_snapshot();
  write_vtk(heap, folder_, "heap");
  const VtpContent read = read_vtp(folder_ / "heap_spheres.vtp");
  ASSERT_EQ(read.points.tuples(), heap.spheres.size());
  EXPECT_EQ(read.piece.at("NumberOfPoints"), std::to_string(heap.spheres.size()));
  for (std::size_t s = 0; s < heap.spheres.size(); ++s) {
    const SphereSnapshot& sphere = heap.spheres[s];
    expect_vector(read.points, s, sphere.centre);
    EXPECT_EQ(value(read.data.at("radius"), s), sphere.radius);
    EXPECT_EQ(value(read.data.at("diameter"), s), 2.0 * sphere.radius);
    EXPECT_EQ(value(read.data.at("body"), s), sphere.body);
    EXPECT_EQ(value(read.data.at("shape"), s), heap.bodies[static_cast<std::size_t>(sphere.body)].shape);
    const Vec3 velocity = velocity_of(heap, sphere);
    for (std::size_t c = 0; c < 3; ++c) {
      // The order of a cross product's sums may differ: rounding of numbers near 1.
      EXPECT_NEAR(value(read.data.at("velocity"), s, c), velocity[static_cast<Eigen::Index>(c)], 1e-14);
    }
    EXPECT_NEAR(value(read.data.at("speed"), s), velocity.norm(), 1e-14);
  }
}

TEST_F(HeapVtk, KeepsEveryNumberOfTheBodiesBitForBit) {
  const HeapSnapshot heap = moving_snapshot();
  write_vtk(heap, folder_, "heap");
  const VtpContent read = read_vtp(folder_ / "heap_bodies.vtp");
  ASSERT_EQ(read.points.tuples(), heap.bodies.size());
  for (std::size_t b = 0; b < heap.bodies.size(); ++b) {
    const BodySnapshot& body = heap.bodies[b];
    expect_vector(read.points, b, body.position);
    expect_vector(read.data.at("velocity"), b, body.velocity);
    expect_vector(read.data.at("angular_velocity"), b, body.angular_velocity);
    EXPECT_EQ(value(read.data.at("orientation"), b, 0), body.orientation.w());
    EXPECT_EQ(value(read.data.at("orientation"), b, 1), body.orientation.x());
    EXPECT_EQ(value(read.data.at("orientation"), b, 2), body.orientation.y());
    EXPECT_EQ(value(read.data.at("orientation"), b, 3), body.orientation.z());
    EXPECT_EQ(value(read.data.at("mass"), b), body.mass);
    EXPECT_EQ(value(read.data.at("volume"), b), body.volume);
    EXPECT_EQ(value(read.data.at("shape"), b), body.shape);
    EXPECT_EQ(value(read.data.at("scale"), b), body.scale);
    const double speed = std::hypot(body.velocity.x(), body.velocity.y(), body.velocity.z());
    const double energy = 0.5 * body.mass * speed * speed;
    EXPECT_NEAR(value(read.data.at("translational_energy"), b), energy, 1e-14 * energy);
  }
}

TEST_F(HeapVtk, EveryPointOfSpheresAndBodiesIsAVertexThatParaViewDraws) {
  const HeapSnapshot heap = moving_snapshot();
  write_vtk(heap, folder_, "heap");
  for (const char* kind : {"heap_spheres.vtp", "heap_bodies.vtp"}) {
    const VtpContent read = read_vtp(folder_ / kind);
    ASSERT_EQ(read.cells.size(), read.points.tuples());
    EXPECT_EQ(read.piece.at("NumberOfVerts"), std::to_string(read.points.tuples()));
    for (std::size_t c = 0; c < read.cells.size(); ++c) {
      EXPECT_EQ(read.cells[c], std::vector<int>{static_cast<int>(c)});
    }
  }
}

/// Newell's formula.
Vec3 area_vector(const VtpContent& read, const std::vector<int>& polygon) {
  const auto point = [&](int number) {
    const auto k = static_cast<std::size_t>(number);
    return Vec3(value(read.points, k, 0), value(read.points, k, 1), value(read.points, k, 2));
  };
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    area += 0.5 * point(polygon[k]).cross(point(polygon[(k + 1) % polygon.size()]));
  }
  return area;
}

/// Summed area of the polygons of one wall, and the extent of its points.
struct WallExtent {
  double area = 0.0;
  Vec3 low = Vec3::Constant(1e9);
  Vec3 high = Vec3::Constant(-1e9);
};

WallExtent extent_of(const VtpContent& read, int wall) {
  WallExtent extent;
  for (const std::vector<int>& polygon : read.cells) {
    if (value(read.data.at("wall"), static_cast<std::size_t>(polygon[0])) != wall) continue;
    extent.area += area_vector(read, polygon).norm();
    for (const int number : polygon) {
      const auto k = static_cast<std::size_t>(number);
      const Vec3 p(value(read.points, k, 0), value(read.points, k, 1), value(read.points, k, 2));
      extent.low = extent.low.cwiseMin(p);
      extent.high = extent.high.cwiseMax(p);
    }
  }
  return extent;
}

TEST_F(HeapVtk, TheBaseIsADiscWithItsSide) {
  const HeapSnapshot heap = moving_snapshot();
  write_vtk(heap, folder_, "heap");
  const WallExtent base = extent_of(read_vtp(folder_ / "heap_walls.vtp"), 0);
  const double exact = kPi * 0.0975 * 0.0975 + 2.0 * kPi * 0.0975 * 0.05;
  // Inscribed polygons are smaller by at most (2π/n)²/6, below 0.1 % from 80 corners.
  EXPECT_NEAR(base.area / exact, 1.0, 1e-3);
  EXPECT_NEAR(base.low.z(), -0.05, 1e-12);
  EXPECT_NEAR(base.high.z(), 0.0, 1e-12);
  EXPECT_NEAR(base.high.x(), 0.0975, 1e-6);
}

TEST_F(HeapVtk, EachHalfOfTheCylinderStandsOnItsOwnSide) {
  const HeapSnapshot heap = moving_snapshot();
  write_vtk(heap, folder_, "heap");
  const VtpContent read = read_vtp(folder_ / "heap_walls.vtp");
  const WallExtent positive = extent_of(read, 1);
  const WallExtent negative = extent_of(read, 2);
  for (const WallExtent& half : {positive, negative}) {
    EXPECT_NEAR(half.area / (kPi * 0.05 * 0.3), 1.0, 1e-3);
    EXPECT_NEAR(half.low.z(), 0.0, 1e-12);
    EXPECT_NEAR(half.high.z(), 0.3, 1e-12);
    EXPECT_NEAR(half.high.y(), 0.05, 1e-12);
    EXPECT_NEAR(half.low.y(), -0.05, 1e-12);
  }
  EXPECT_NEAR(positive.low.x(), 0.012, 1e-12);
  EXPECT_NEAR(positive.high.x(), 0.062, 1e-12);
  EXPECT_NEAR(negative.low.x(), -0.062, 1e-12);
  EXPECT_NEAR(negative.high.x(), -0.012, 1e-12);
}

TEST_F(HeapVtk, AnUnboundedBaseReachesBeyondEveryBody) {
  HeapSnapshot heap = moving_snapshot();
  heap.base_radius = std::numeric_limits<double>::infinity();
  heap.shells.clear();
  heap.spheres.push_back({{-0.7, 0.3, 0.01}, 0.004, 0});
  write_vtk(heap, folder_, "heap");
  const WallExtent base = extent_of(read_vtp(folder_ / "heap_walls.vtp"), 0);
  EXPECT_LT(base.low.x(), -0.7);
  EXPECT_GT(base.high.y(), 0.3);
  EXPECT_EQ(base.low.z(), 0.0);
  EXPECT_EQ(base.high.z(), 0.0);
}

TEST_F(HeapVtk, AnEmptyHeapIsStillThreeGoodFiles) {
  HeapSnapshot heap;
  heap.base_radius = 0.1;
  write_vtk(heap, folder_, "empty");
  EXPECT_EQ(read_vtp(folder_ / "empty_spheres.vtp").points.tuples(), 0U);
  EXPECT_EQ(read_vtp(folder_ / "empty_bodies.vtp").points.tuples(), 0U);
  EXPECT_FALSE(read_vtp(folder_ / "empty_walls.vtp").cells.empty());
}

TEST_F(HeapVtk, NamesTheFileThatCannotBeWritten) {
  const std::filesystem::path missing = folder_ / "no" / "such" / "folder";
  try {
    write_vtk(moving_snapshot(), missing, "heap");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find((missing / "heap_spheres.vtp").string()), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace repose
