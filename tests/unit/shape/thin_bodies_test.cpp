// Plates, discs and needles, of which few spheres tell little: a clump comes out all the same, of spheres
// that belong to the body, or a refusal.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/shape/bodies.hpp"
#include "engine/shape/clump_generator.hpp"
#include "engine/shape/clump_mass.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

struct Thin {
  std::string name;
  Mesh mesh;
  int spheres;
};

/// The cases that once gave spheres of 138 mm for a plate of 10 mm, or no end.
std::vector<Thin> thin_bodies() {
  const auto box = [](double x, double y, double z) { return box_mesh(1e-3 * Vec3(x, y, z)); };
  const auto disc = [](double thickness) {
    return turned_mesh({{0.0, 0.0}, {5e-3, 0.0}, {5e-3, thickness}, {0.0, thickness}}, 40);
  };
  return {{"plate 10:1", box(10, 10, 1), 3},    {"plate 10:1", box(10, 10, 1), 5},
          {"plate 14:1", box(10, 10, 0.7), 8},  {"plate 20:1", box(10, 10, 0.5), 3},
          {"plate 20:1", box(10, 10, 0.5), 12}, {"plate 50:1", box(10, 10, 0.2), 5},
          {"disc 10:1", disc(1e-3), 5},         {"disc 40:1", disc(0.25e-3), 4},
          {"lath 20:10:1", box(20, 10, 1), 6},  {"needle 10:1", box(5, 0.5, 0.5), 3},
          {"needle 20:1", box(10, 0.5, 0.5), 5}};
}

TEST(ThinBodies, GetSpheresThatBelongToThem) {
  for (const Thin& thin : thin_bodies()) {
    const std::string shown = thin.name + ", " + std::to_string(thin.spheres);
    const GeneratedClump made = generate_clump(thin.mesh, {.spheres = thin.spheres});
    Eigen::AlignedBox3d body;
    for (const Vec3& vertex : in_principal_frame(thin.mesh).vertices) body.extend(vertex);
    const double slack = 1e-9 * body.sizes().norm();  // rounding of the units of the fit
    // 1.5 times the largest ball inside or the radius of one of N equal balls of the body's volume.
    const double equal = 0.5 * made.clump.equivalent_diameter() / std::cbrt(thin.spheres);
    const double largest = 1.5 * std::max(0.5 * body.sizes().minCoeff(), equal);
    for (const Sphere& sphere : made.clump.spheres) {
      EXPECT_LE(sphere.radius, largest + slack) << shown;
      EXPECT_LE(body.exteriorDistance(sphere.centre), slack) << shown;
    }
    EXPECT_TRUE(mass_faults(made.clump).empty()) << shown;
    // What spheres of this size leave of the volume: they may overlap, and a chain of pearls has gaps.
    EXPECT_LT(made.errors.volume_error, 0.5) << shown;
  }
}

TEST(ThinBodies, KeepTheirVolumeWhereBallsOfItFitTheOutline) {
  for (const Thin& thin : thin_bodies()) {
    if (thin.name.starts_with("needle")) continue;
    const GeneratedClump made = generate_clump(thin.mesh, {.spheres = thin.spheres});
    // Two per cent for the coarsest of them, three spheres for a plate; what is wrong is the surface.
    EXPECT_LT(made.errors.volume_error, 0.02) << thin.name << ", " << thin.spheres;
  }
}

TEST(ThinBodies, AreRefusedWhereTheSpheresCannotHaveTheirMassProperties) {
  try {
    generate_clump(box_mesh(1e-3 * Vec3(20.0, 0.2, 0.2)), {.spheres = 1});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("spheres = 1: is too few for a body as thin as this"));
  }
}

TEST(ThinBodies, AreNotFoundGoodBeforeTheirMassPropertiesAre) {
  const GeneratedClump made =
      generate_clump(box_mesh(1e-3 * Vec3(20.0, 0.5, 0.5)), {.surface_error = 0.5, .max_spheres = 30});
  EXPECT_TRUE(made.met);
  EXPECT_TRUE(mass_faults(made.clump).empty());
  EXPECT_GT(made.clump.spheres.size(), 1u);
}

}  // namespace
}  // namespace repose
