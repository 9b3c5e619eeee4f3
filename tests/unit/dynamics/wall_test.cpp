#include "engine/dynamics/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/random.hpp"

namespace repose {
namespace {

constexpr double kRadius = 0.05;
constexpr double kSpacing = 1e-3;  ///< of the points that stand for a surface

/// Points on a cylinder's side between two heights and two angles.
void add_side(std::vector<Vec3>& points, double low, double high, double from, double to, double x_offset) {
  const int turns = static_cast<int>((to - from) * kRadius / kSpacing),
            rows = static_cast<int>((high - low) / kSpacing);
  for (int t = 0; t <= turns; ++t)
    for (int r = 0; r <= rows; ++r) {
      const double angle = from + (to - from) * t / turns;
      points.emplace_back(x_offset + kRadius * std::cos(angle), kRadius * std::sin(angle),
                          low + (high - low) * r / rows);
    }
}
void add_disk(std::vector<Vec3>& points, double height) {
  for (double rho = 0.0; rho <= kRadius + 1e-12; rho += kSpacing) {
    const int turns = 1 + static_cast<int>(2.0 * kPi * rho / kSpacing);
    for (int t = 0; t < turns; ++t)
      points.emplace_back(rho * std::cos(2.0 * kPi * t / turns), rho * std::sin(2.0 * kPi * t / turns),
                          height);
  }
}

/// The distance by the wall's formula against the nearest of many points on its surface. Points stand at most
/// s = kSpacing/√2 from the true nearest point, and a point on the arc at s from it lies √(d² + (1 + d/R) s²)
/// away. The normal points from the surface to the point.
void compare(const Wall& wall, const std::vector<Vec3>& surface, const Vec3& point, double sign) {
  double sampled = 1e9;
  for (const Vec3& on : surface) sampled = std::min(sampled, (point - on).norm());
  const WallDistance exact = distance_to(wall, point);
  const double d = sign * exact.distance;
  ASSERT_GE(d, -1e-12) << point.transpose();
  EXPECT_LE(d, sampled + 1e-12) << point.transpose();
  EXPECT_LE(sampled, std::hypot(d, 0.75 * kSpacing * std::sqrt(1.0 + d / kRadius)) + 1e-12)
      << point.transpose();
  EXPECT_NEAR(exact.normal.norm(), 1.0, 1e-12);
  if (d < 1e-6) return;
  // Stepping back along the normal by the distance ends on the surface.
  const Vec3 foot = point - exact.distance * exact.normal;
  double off = 1e9;
  for (const Vec3& on : surface) off = std::min(off, (foot - on).norm());
  EXPECT_LE(off, 0.75 * kSpacing) << point.transpose();
}

Vec3 random_point(RandomStream& random) {
  return {random.uniform(-0.12, 0.12), random.uniform(-0.12, 0.12), random.uniform(-0.1, 0.15)};
}

TEST(WallDistance, OfThinShellsIsThatOfDenseSampling) {
  RandomStream random(1, 1);
  struct Case {
    Wall::Kind kind;
    double from, to;
  };
  for (const Case& c : {Case{Wall::Kind::open_shell, 0.0, 2.0 * kPi},
                        Case{Wall::Kind::half_shell_plus, -0.5 * kPi, 0.5 * kPi},
                        Case{Wall::Kind::half_shell_minus, 0.5 * kPi, 1.5 * kPi}}) {
    Wall wall{c.kind, kRadius, 0.01, 0.06, 0.02};
    std::vector<Vec3> surface;
    add_side(surface, 0.01, 0.06, c.from, c.to, 0.02);
    for (int k = 0; k < 300; ++k) compare(wall, surface, random_point(random), 1.0);
  }
}

TEST(WallDistance, OfTheBaseIsThatOfDenseSamplingOutsideAndNearItsTopInside) {
  RandomStream random(2, 1);
  Wall base;
  base.radius = kRadius;
  base.z_low = -0.05;
  std::vector<Vec3> surface;
  add_disk(surface, 0.0);
  add_side(surface, -0.05, 0.0, 0.0, 2.0 * kPi, 0.0);
  int inside = 0, outside = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 point = random_point(random);
    const bool in = std::hypot(point.x(), point.y()) < kRadius && point.z() < 0.0;
    // Nothing comes below: bodies that sink under the top leave the simulation.
    if (point.z() < -0.05 || (in && point.z() < -0.02)) continue;
    compare(base, surface, point, in ? -1.0 : 1.0);
    ++(in ? inside : outside);
  }
  EXPECT_GT(inside, 5);
  EXPECT_GT(outside, 200);
}

TEST(WallDistance, OfTheClosedCylinderPushesInwardsFromBothSides) {
  RandomStream random(3, 1);
  const Wall wall{Wall::Kind::closed_shell, kRadius, 0.0, 0.1, 0.0};
  for (int k = 0; k < 100; ++k) {
    const double rho = random.uniform(0.001, 0.1), phi = random.uniform(0.0, 2.0 * kPi);
    const WallDistance seen = distance_to(wall, {rho * std::cos(phi), rho * std::sin(phi), 0.05});
    EXPECT_NEAR(seen.distance, kRadius - rho, 1e-15);
    EXPECT_NEAR(seen.normal.dot(Vec3(std::cos(phi), std::sin(phi), 0.0)), -1.0, 1e-12);
  }
}

TEST(WallDistance, OfTheUnboundedBaseIsTheHeight) {
  const Wall base;
  EXPECT_EQ(distance_to(base, {3.0, -7.0, 0.004}).distance, 0.004);
  EXPECT_EQ(distance_to(base, {3.0, -7.0, -0.001}).distance, -0.001);
  EXPECT_EQ(distance_to(base, {3.0, -7.0, 0.004}).normal, Vec3::UnitZ());
}

TEST(WallDistance, IsFiniteOnTheAxisAndOnTheSurface) {
  for (const auto kind : {Wall::Kind::base, Wall::Kind::closed_shell, Wall::Kind::open_shell,
                          Wall::Kind::half_shell_plus, Wall::Kind::half_shell_minus}) {
    const Wall wall{kind, kRadius, kind == Wall::Kind::base ? -0.05 : 0.0, 0.1, 0.0};
    for (const Vec3& point : {Vec3(0.0, 0.0, 0.05), Vec3(kRadius, 0.0, 0.05), Vec3(0.0, kRadius, 0.0),
                              Vec3(-kRadius, 0.0, 0.1), Vec3(0.0, 0.0, 0.0)}) {
      const WallDistance seen = distance_to(wall, point);
      EXPECT_FALSE(std::isnan(seen.distance));
      EXPECT_NEAR(seen.normal.norm(), 1.0, 1e-12);
    }
  }
}

/// Without tolerance: both say the same but where rounding decides, 1e-12 m on either side of the reach.
TEST(WithinReach, SaysWhatTheDistanceSays) {
  RandomStream random(11, 4);
  int near = 0;
  for (int k = 0; k < 20000; ++k) {
    Wall wall;
    wall.kind = static_cast<Wall::Kind>(k % 5);
    wall.radius = kRadius;
    wall.z_low = wall.kind == Wall::Kind::base ? -0.02 : 0.0;
    wall.z_high = 0.1;
    wall.x_offset = wall.kind == Wall::Kind::base ? 0.0 : random.uniform(-0.01, 0.01);
    const Vec3 point(random.uniform(-0.08, 0.08), random.uniform(-0.08, 0.08), random.uniform(-0.03, 0.1));
    const double reach = random.uniform(0.0, 0.07), distance = distance_to(wall, point).distance;
    if (std::abs(distance - reach) < 1e-12) continue;
    EXPECT_EQ(within_reach(wall, point, reach), distance < reach) << k;
    near += distance < reach ? 1 : 0;
  }
  EXPECT_GT(near, 2000);
}

TEST(WithinReach, OfAClosedShellGoesOnAboveItsRim) {
  const Wall shell{Wall::Kind::closed_shell, kRadius, 0.0, 0.1, 0.0};
  const Vec3 above(kRadius - 1e-3, 0.0, 0.3);
  EXPECT_FALSE(distance_to(shell, above).distance < 2e-3);
  EXPECT_TRUE(within_reach(shell, above, 2e-3));
  EXPECT_FALSE(within_reach(shell, above, 0.5e-3));
}

}  // namespace
}  // namespace repose
