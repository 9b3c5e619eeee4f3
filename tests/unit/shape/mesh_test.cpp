#include "engine/shape/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"
#include "engine/shape/bodies.hpp"

namespace repose {
namespace {

// Polyhedra are exact but for rounding.
constexpr double kRounding = 1e-13;

TEST(MeshMeasures, OfABoxAreThoseOfTheBook) {
  const Vec3 s(2.0, 3.0, 5.0);
  const MeshMeasures box = measure(box_mesh(s));
  EXPECT_NEAR(box.volume, 30.0, 30 * kRounding);
  EXPECT_NEAR(box.area, 62.0, 62 * kRounding);
  EXPECT_NEAR(box.centroid.norm(), 0.0, kRounding);
  EXPECT_TRUE(box.extents.isApprox(s, kRounding));
  const Vec3 moments = 30.0 / 12.0 * Vec3(9 + 25, 4 + 25, 4 + 9);
  EXPECT_LT((box.inertia() - Mat3(moments.asDiagonal())).norm(), 1e2 * kRounding);
}

TEST(MeshMeasures, OfACornerTetrahedronAreThoseOfTheIntegral) {
  const double a = 1.0;
  const double b = 2.0;
  const double c = 3.0;
  const MeshMeasures body = measure(corner_tetrahedron(a, b, c));
  const double volume = a * b * c / 6.0;
  EXPECT_NEAR(body.volume, volume, kRounding);
  EXPECT_NEAR((body.centroid - Vec3(a, b, c) / 4.0).norm(), 0.0, kRounding);
  // ∫x² = V a²/10, ∫xy = V ab/20 about the corner; about the centroid less V c cᵀ.
  EXPECT_NEAR(body.second(0, 0), volume * a * a * (1.0 / 10 - 1.0 / 16), kRounding);
  EXPECT_NEAR(body.second(1, 2), volume * b * c * (1.0 / 20 - 1.0 / 16), kRounding);
}

TEST(MeshMeasures, OfFineMeshesApproachTheSmoothBody) {
  // A facet of edge h lies h²/8R below the surface: at level 6 h ≈ 0.02 R, volume and moments within a few
  // 1e-4.
  const MeshMeasures ball = measure(icosphere(6));
  EXPECT_NEAR(ball.volume / (4.0 / 3.0 * kPi), 1.0, 3e-4);
  EXPECT_NEAR(ball.area / (4.0 * kPi), 1.0, 3e-4);
  EXPECT_NEAR(ball.inertia()(2, 2) / (8.0 / 15.0 * kPi), 1.0, 6e-4);
  EXPECT_NEAR(ball.sphericity(), 1.0, 1e-4);

  const double R = 3.0;
  const double r = 1.0;
  const MeshMeasures torus = measure(torus_mesh(R, r, 400, 200));
  const double volume = 2.0 * kPi * kPi * R * r * r;
  EXPECT_NEAR(torus.volume / volume, 1.0, 3e-4);
  EXPECT_NEAR(torus.area / (4.0 * kPi * kPi * R * r), 1.0, 3e-4);
  EXPECT_NEAR(torus.inertia()(2, 2) / (volume * (R * R + 0.75 * r * r)), 1.0, 6e-4);
  EXPECT_NEAR(torus.inertia()(0, 0) / (volume * (0.5 * R * R + 0.625 * r * r)), 1.0, 6e-4);

  const MeshMeasures cone = measure(cone_mesh(1.0, 2.0, 800));
  EXPECT_NEAR(cone.volume / (2.0 / 3.0 * kPi), 1.0, 2e-5);
  EXPECT_NEAR(cone.centroid.z(), 0.5, 1e-12);
  EXPECT_NEAR(cone.inertia()(2, 2) / (0.3 * 2.0 / 3.0 * kPi), 1.0, 4e-5);

  const MeshMeasures capsule = measure(capsule_mesh(1.0, 2.0, 400));
  EXPECT_NEAR(capsule.volume / (2.0 * kPi + 4.0 / 3.0 * kPi), 1.0, 2e-4);
  EXPECT_NEAR(capsule.area / (8.0 * kPi), 1.0, 2e-4);
}

TEST(MeshMeasures, DoNotDependOnWhereTheBodyIs) {
  Mesh body = octahedron_mesh(0.004);
  const MeshMeasures here = measure(body);
  RandomStream random(4, 0);
  const Mat3 turn = random.rotation().toRotationMatrix();
  for (Vec3& vertex : body.vertices) vertex = turn * vertex + Vec3(1.0, -2.0, 0.5);
  const MeshMeasures there = measure(body);
  // Coordinates of 1 m carry 1e-16 m, the body is 4e-3 m.
  EXPECT_NEAR(there.volume / here.volume, 1.0, 1e-11);
  EXPECT_LT((there.inertia() - turn * here.inertia() * turn.transpose()).norm() / here.inertia().norm(),
            1e-10);
}

TEST(PrincipalFrame, PutsTheBodyStraight) {
  Mesh body = box_mesh(Vec3(1.0, 2.0, 3.0));
  RandomStream random(8, 0);
  const Mat3 turn = random.rotation().toRotationMatrix();
  for (Vec3& vertex : body.vertices) vertex = turn * vertex + Vec3(0.3, 0.1, 7.0);
  const MeshMeasures straight = measure(in_principal_frame(body));
  EXPECT_LT(straight.centroid.norm(), 1e-12);
  // The least moment is about the longest side.
  EXPECT_TRUE(straight.extents.isApprox(Vec3(3.0, 2.0, 1.0), 1e-12));
  EXPECT_NEAR(principal_frame(measure(body).inertia()).axes.determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace repose
