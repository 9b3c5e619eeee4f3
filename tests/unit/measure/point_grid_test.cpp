#include "engine/measure/point_grid.hpp"

#include <gtest/gtest.h>

#include <set>

namespace repose {
namespace {

std::vector<Vec3> scattered(int count, double extent, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double x = random.uniform(-extent, extent);
    const double y = random.uniform(-extent, extent);
    points.emplace_back(x, y, random.uniform(-extent, extent));
  }
  return points;
}

TEST(PointGrid, FindsWhatASearchOverAllPointsFinds) {
  const std::vector<Vec3> points = scattered(500, 3.0, 7);
  const PointGrid grid(points, 0.4);
  for (const double radius : {0.1, 0.4, 1.3}) {
    for (std::size_t i = 0; i < points.size(); i += 17) {
      std::set<std::size_t> found;
      grid.each_within(points[i], radius, [&](std::size_t j, double) { found.insert(j); });
      std::set<std::size_t> expected;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if ((points[j] - points[i]).norm() <= radius) expected.insert(j);
      }
      EXPECT_EQ(found, expected) << "radius " << radius << " around point " << i;
    }
  }
}

TEST(PointGrid, HoldsAPointVeryFarAway) {
  std::vector<Vec3> points = scattered(50, 1.0, 3);
  points.emplace_back(1e6, -1e6, 1e6);
  const PointGrid grid(points, 1e-2);
  int found = 0;
  grid.each_within(points.back(), 1e-2, [&](std::size_t j, double) { found += j == 50 ? 1 : 0; });
  EXPECT_GE(found, 1);
}

}  // namespace
}  // namespace repose
