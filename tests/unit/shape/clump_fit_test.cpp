#include "engine/shape/clump_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"
#include "engine/shape/bodies.hpp"
#include "engine/shape/facet_tree.hpp"
#include "engine/shape/medial_balls.hpp"
#include "engine/shape/surface_samples.hpp"

namespace repose {
namespace {

/// Points on the union's surface, about evenly spread.
std::vector<Vec3> surface_of(const std::vector<Sphere>& spheres, std::size_t count) {
  RandomStream random(2, 0);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Sphere& sphere = spheres[random.below(spheres.size())];
    const Vec3 point =
        sphere.centre + sphere.radius * Vec3(random.normal(), random.normal(), random.normal()).normalized();
    bool covered = false;
    for (const Sphere& other : spheres)
      covered = covered || (&other != &sphere && (point - other.centre).norm() < other.radius);
    if (!covered) points.push_back(point);
  }
  return points;
}

TEST(ClumpFit, FindsTheSpheresThatASurfaceIsMadeOf) {
  const std::vector<Sphere> truth = {
      {Vec3(0.2, 0.0, 0.0), 0.3}, {Vec3(-0.2, 0.05, 0.0), 0.25}, {Vec3(0.0, -0.2, 0.1), 0.2}};
  FitTarget target;
  target.points = surface_of(truth, 600);
  std::vector<Sphere> spheres = truth;
  RandomStream random(7, 0);
  for (Sphere& sphere : spheres) {
    sphere.centre += 0.05 * Vec3(random.normal(), random.normal(), random.normal());
    sphere.radius *= random.uniform(0.85, 1.15);
  }
  const double value = fit_spheres(spheres, target, {.iterations = 100, .tolerance = 1e-12});
  EXPECT_LT(value, 1e-12);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_LT((spheres[k].centre - truth[k].centre).norm(), 1e-5);
    EXPECT_NEAR(spheres[k].radius, truth[k].radius, 1e-5);
  }
}

TEST(ClumpFit, MeetsVolumeAndInertiaWhereTheyCount) {
  // The surface asks for a ball of radius 0.5, the mass properties for one of 2 % more volume.
  FitTarget target;
  target.points = surface_of({{Vec3::Zero(), 0.5}}, 400);
  const double radius = 0.5 * std::cbrt(1.02);
  target.volume = 4.0 / 3.0 * kPi * std::pow(radius, 3);
  target.moments = Vec3::Constant(8.0 / 15.0 * kPi * std::pow(radius, 5));
  std::vector<Sphere> spheres = {{Vec3(0.01, 0.0, 0.0), 0.49}};
  fit_spheres(spheres, target, {.mass_weight = 30.0, .tolerance = 1e-12});
  EXPECT_NEAR(spheres[0].radius, radius, 1e-5);
  EXPECT_LT(spheres[0].centre.norm(), 1e-3);
}

TEST(SurfaceGaps, AreDistancesFromTheUnion) {
  const SurfaceGaps gaps =
      surface_gaps({{Vec3::Zero(), 1.0}, {Vec3(3, 0, 0), 0.5}}, {Vec3(0, 2, 0), Vec3(2.75, 0, 0)});
  EXPECT_DOUBLE_EQ(gaps.gap[0], 1.0);
  EXPECT_EQ(gaps.owner[0], 0u);
  EXPECT_DOUBLE_EQ(gaps.gap[1], -0.25);
  EXPECT_EQ(gaps.owner[1], 1u);
}

TEST(MedialBalls, OfABoxAreBoundedByItsSides) {
  const SurfaceSamples samples = sample_surface(box_mesh(Vec3(2.0, 2.0, 6.0)), 3000);
  double largest = 0.0;
  for (const Sphere& ball : medial_balls(samples, 0.0)) {
    largest = std::max(largest, ball.radius);
    const double inside = std::min(
        {1.0 - std::abs(ball.centre.x()), 1.0 - std::abs(ball.centre.y()), 3.0 - std::abs(ball.centre.z())});
    // Samples are up to 0.3 apart: a ball of radius r may stand out by 0.15² / 2r between them, at r ≥ 0.08.
    EXPECT_LT(ball.radius - inside, 0.14);
  }
  EXPECT_NEAR(largest, 1.0, 0.02);
}

TEST(SurfaceSamples, AreSpreadEvenlyOverTheSurface) {
  const Mesh torus = torus_mesh(2.0, 0.7, 60, 30);
  const SurfaceSamples samples = sample_surface(torus, 4000);
  ASSERT_EQ(samples.points.size(), 4000u);
  const FacetTree tree(torus);
  Vec3 mean = Vec3::Zero();
  int outer = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    mean += samples.points[i] / 4000.0;
    outer += samples.points[i].head<2>().norm() > 2.0 ? 1 : 0;
    EXPECT_LT(tree.distance(samples.points[i]), 1e-12);
    EXPECT_NEAR(samples.normals[i].norm(), 1.0, 1e-12);
  }
  EXPECT_LT(mean.norm(), 0.02);
  // Share of a torus's surface beyond its middle circle: ½ + r/(π R).
  EXPECT_NEAR(outer / 4000.0, 0.5 + 0.7 / (kPi * 2.0), 0.01);
}

TEST(FacetTree, FindsTheNearestPointLikeASearchOfAllFacets) {
  const Mesh mesh = torus_mesh(1.0, 0.4, 20, 10);
  const FacetTree tree(mesh);
  RandomStream random(5, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 1.5 * Vec3(random.normal(), random.normal(), random.normal());
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.facets)
      nearest = std::min(
          nearest, (closest_on_triangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) - p).norm());
    EXPECT_DOUBLE_EQ(tree.distance(p), nearest);
  }
  // Above a corner, an edge and the inside of one triangle.
  const Vec3 a(0, 0, 0);
  const Vec3 b(1, 0, 0);
  const Vec3 c(0, 1, 0);
  EXPECT_EQ(closest_on_triangle(Vec3(-1, -2, 1), a, b, c), a);
  EXPECT_TRUE(closest_on_triangle(Vec3(0.5, -2, 1), a, b, c).isApprox(Vec3(0.5, 0, 0)));
  EXPECT_TRUE(closest_on_triangle(Vec3(1, 1, 1), a, b, c).isApprox(Vec3(0.5, 0.5, 0)));
  EXPECT_TRUE(closest_on_triangle(Vec3(0.2, 0.3, -4), a, b, c).isApprox(Vec3(0.2, 0.3, 0)));
}

}  // namespace
}  // namespace repose
