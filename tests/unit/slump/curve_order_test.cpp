#include "engine/slump/curve_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "engine/base/random.hpp"

namespace repose::test {
namespace {

TEST(CurveOrder, FollowsTheCurveThroughACube) {
  // The eight cells of a cube in the order of the bits z y x, given in reverse, and a second point in the
  // first cell.
  std::vector<Vec3> points;
  for (int code = 7; code >= 0; --code)
    points.push_back({1.0 * (code & 1), 1.0 * (code >> 1 & 1), 1.0 * (code >> 2 & 1)});
  points.push_back({0.1, 0.2, 0.3});
  EXPECT_EQ(curve_order(points, 1.0), (std::vector<std::size_t>{7, 8, 6, 5, 4, 3, 2, 1, 0}));
  EXPECT_TRUE(curve_order({}, 1.0).empty());
}

TEST(CurveOrder, BringsNeighboursTogether) {
  RandomStream random(1, 4);
  std::vector<Vec3> points;
  for (int k = 0; k < 4000; ++k)
    points.push_back({random.uniform(), random.uniform(), 3.0 * random.uniform()});
  const std::vector<std::size_t> order = curve_order(points, 0.05);
  std::vector<std::size_t> sorted = order;
  std::ranges::sort(sorted);
  for (std::size_t k = 0; k < sorted.size(); ++k) ASSERT_EQ(sorted[k], k);
  double apart = 0.0, along = 0.0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    apart += (points[k] - points[k - 1]).norm();
    along += (points[order[k]] - points[order[k - 1]]).norm();
  }
  EXPECT_LT(along, 0.15 * apart);  // a cell's edge and some jumps, against a third of the box
}

TEST(CurveOrder, BearsPointsBeyondItsCells) {
  const std::vector<Vec3> points{{1e6, 0.0, 0.0}, {0.0, 0.0, 0.0}, {2e6, 0.0, 0.0}};
  EXPECT_EQ(curve_order(points, 1e-3), (std::vector<std::size_t>{1, 0, 2}));
}

}  // namespace
}  // namespace repose::test
