#include "engine/shape/clump_generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/shape/bodies.hpp"
#include "engine/shape/mesh_file.hpp"
#include "engine/shape/union_of_spheres.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

bool same(const Clump& a, const Clump& b) {
  return std::equal(
      a.spheres.begin(), a.spheres.end(), b.spheres.begin(), b.spheres.end(),
      [](const Sphere& s, const Sphere& t) { return s.centre == t.centre && s.radius == t.radius; });
}

TEST(ClumpErrors, OfABallInACubeAreThoseOfTheBook) {
  const ClumpErrors errors = clump_errors({{Vec3::Zero(), 0.5}}, box_mesh(Vec3::Constant(1.0)));
  const double volume = kPi / 6.0;
  EXPECT_NEAR(errors.volume_error, 1.0 - volume, 1e-9);
  EXPECT_NEAR(errors.eit_error, 1.0 - 0.4 * volume * 0.25 * 6.0, 1e-9);
  EXPECT_NEAR(errors.sphericity, 1.0, 1e-9);
  const double diameter = std::cbrt(6.0 / kPi);
  // Farthest from the cube is the ball's point on the diagonal: ½ − ½/√3; the point nearest to it of the
  // spiral.
  EXPECT_NEAR(errors.max_distance * diameter, 0.5 - 0.5 / std::sqrt(3.0), 5e-3);
  // Mean over the sphere of ½ − max|n|/2; the mean of max|n| over directions is 0.8318 (numerical
  // quadrature).
  EXPECT_NEAR(errors.mean_distance * diameter, 0.5 - 0.5 * 0.8318, 2e-3);
  EXPECT_LT(errors.computation_error, 2e-4);
}

TEST(ClumpGenerator, MakesOneSphereOfABall) {
  const GeneratedClump made = generate_clump(ellipsoid_mesh(Vec3::Constant(0.004), 4), {.spheres = 1});
  ASSERT_EQ(made.clump.spheres.size(), 1u);
  EXPECT_NEAR(made.clump.spheres[0].radius, 0.004,
              0.004 * 2e-3);  // the mesh is that much smaller than the ball
  EXPECT_LT(made.errors.volume_error, 1e-4);
  EXPECT_LT(made.errors.eit_error, 3e-3);
  EXPECT_LT(made.errors.mean_distance, 1e-3);
}

TEST(ClumpGenerator, MeetsTheBarsOnTheOreParticles) {
  for (const char* file : {"cases/shapes/particle_13.stl", "cases/shapes/particle_33.stl"}) {
    const GeneratedClump made = generate_clump(read_mesh(file), {.spheres = 30, .starts = 1});
    EXPECT_EQ(made.clump.spheres.size() + made.inner.size(), 30u);
    EXPECT_LT(made.errors.volume_error, 0.003) << file;
    EXPECT_LT(made.errors.eit_error, 0.003) << file;
    EXPECT_LT(made.errors.computation_error, 2e-4) << file;
    EXPECT_LT(made.errors.mean_distance, 0.02) << file;
    EXPECT_LT(made.errors.centre_offset, 1e-3) << file;
  }
}

TEST(ClumpGenerator, CarriesTheMeshsMassPropertiesInItsPrincipalFrame) {
  Mesh cone = cone_mesh(0.004, 0.008, 48);
  const MeshMeasures body = measure(cone);
  for (Vec3& vertex : cone.vertices) vertex += Vec3(0.1, -0.2, 0.3);
  const GeneratedClump made = generate_clump(cone, {.spheres = 8, .starts = 1});
  EXPECT_NEAR(made.clump.volume / body.volume, 1.0, 1e-9);
  EXPECT_TRUE(made.clump.inertia.isApprox(principal_frame(body.inertia()).moments, 1e-8));
  const MassProperties clump = mass_properties(unite(made.clump.spheres, 400).moments);
  const double diameter = made.clump.equivalent_diameter();
  EXPECT_LT(clump.centre.norm(), 2e-3 * diameter);
  const Mat3 off_diagonal = clump.inertia - Mat3(clump.inertia.diagonal().asDiagonal());
  EXPECT_LT(off_diagonal.norm(), 5e-3 * clump.inertia.norm());
}

TEST(ClumpGenerator, GivesTheSameBitsForTheSameSeed) {
  const Mesh mesh = octahedron_mesh(0.005);
  const GeneratedClump one = generate_clump(mesh, {.spheres = 7, .seed = 3});
  EXPECT_TRUE(same(one.clump, generate_clump(mesh, {.spheres = 7, .seed = 3}).clump));
  EXPECT_FALSE(same(one.clump, generate_clump(mesh, {.spheres = 7, .seed = 4}).clump));
}

TEST(ClumpGenerator, DoesNotDependOnSizeOrPlace) {
  const Mesh mesh = box_mesh(Vec3(0.004, 0.006, 0.009));
  Mesh other = mesh;
  for (Vec3& vertex : other.vertices) vertex = 512.0 * vertex;  // a power of two keeps every digit
  const ClumpErrors a = generate_clump(mesh, {.spheres = 6}).errors;
  const ClumpErrors b = generate_clump(other, {.spheres = 6}).errors;
  EXPECT_NEAR(a.mean_distance, b.mean_distance, 1e-6);
  EXPECT_NEAR(a.volume_error, b.volume_error, 1e-6);
}

TEST(ClumpGenerator, FindsTheFewestSpheres) {
  const Mesh mesh = ellipsoid_mesh(Vec3(0.008, 0.004, 0.004), 3);
  const ClumpOptions options = {.volume_error = 0.013, .eit_error = 0.009};
  const GeneratedClump made = generate_clump(mesh, options);
  ASSERT_TRUE(made.met);
  EXPECT_LE(made.errors.volume_error, 0.013);
  EXPECT_LE(made.errors.eit_error, 0.009);
  const int count = static_cast<int>(made.clump.spheres.size() + made.inner.size());
  ASSERT_GT(count, 1);
  EXPECT_LE(count, 12);
  const ClumpErrors fewer = generate_clump(mesh, {.spheres = count - 1}).errors;
  EXPECT_TRUE(fewer.volume_error > 0.013 || fewer.eit_error > 0.009);
  EXPECT_FALSE(generate_clump(mesh, {.surface_error = 1e-4, .max_spheres = 2}).met);
}

TEST(ClumpGenerator, KeepsTheSmallestRadius) {
  const Mesh mesh = box_mesh(Vec3::Constant(0.008));
  const double free = generate_clump(mesh, {.spheres = 20, .starts = 1}).clump.smallest_radius();
  const double bound = 1.3 * free;
  const GeneratedClump made = generate_clump(mesh, {.spheres = 20, .min_radius = bound, .starts = 1});
  EXPECT_GE(made.clump.smallest_radius(), bound * (1.0 - 1e-12));
  EXPECT_LT(made.errors.volume_error, 0.003);
}

TEST(ClumpGenerator, NamesEveryWrongOption) {
  const Mesh mesh = box_mesh(Vec3::Constant(0.008));
  try {
    generate_clump(mesh, {.spheres = 0, .volume_error = 1.3, .min_radius = 1.0, .max_spheres = 0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("spheres = 0: must be 1 to 300"));
    EXPECT_THAT(error.what(), HasSubstr("volume error = 1.3: must be between 0 and 1"));
    EXPECT_THAT(error.what(), HasSubstr("smallest radius = 1 m: must be at least 0 and below half"));
    EXPECT_THAT(error.what(), HasSubstr("most spheres = 0"));
    EXPECT_THAT(error.what(), HasSubstr("either a number of spheres or at least one bound"));
  }
  EXPECT_THROW(generate_clump(mesh, {}), InputError);
}

}  // namespace
}  // namespace repose
