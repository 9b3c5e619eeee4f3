#include "tools/report/heap_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.hpp"

namespace repose::test {
namespace {

TEST(VisibleDiscs, AreAllWhereNoneIsBehindAnother) {
  std::vector<Disc> discs;
  for (int k = 0; k < 10; ++k) discs.push_back({2.0 * k, 0.0, 1.0, 0.1 * (k % 3), k});
  EXPECT_EQ(visible_discs(discs, 0.05).size(), 10U);
  EXPECT_TRUE(visible_discs({}, 0.05).empty());
}

TEST(VisibleDiscs, AreWithoutThoseThatOthersCover) {
  const Disc small{0.0, 0.0, 1.0, 0.0, 1}, large{0.1, 0.1, 2.0, 1.0, 2}, beside{2.5, 0.0, 1.0, 0.5, 3};
  const std::vector<Disc> seen = visible_discs({large, small, beside}, 0.05);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].shade, 3);  // from the back
  EXPECT_EQ(seen[1].shade, 2);
}

/// The picture is the same with and without the hidden ones: at random points the disc in front is the same.
TEST(VisibleDiscs, LeaveThePictureAsItIs) {
  RandomStream random(3, 1);
  std::vector<Disc> discs;
  for (int k = 0; k < 3000; ++k)
    discs.push_back({random.uniform(0.0, 20.0), random.uniform(0.0, 20.0), random.uniform(0.5, 1.5),
                     random.uniform(), k});
  const std::vector<Disc> seen = visible_discs(discs, 0.05);
  EXPECT_LT(seen.size(), discs.size() / 4);
  const auto in_front = [](const std::vector<Disc>& of, double u, double v) {
    const Disc* front = nullptr;
    for (const Disc& disc : of)
      if (std::hypot(disc.u - u, disc.v - v) < disc.radius && (front == nullptr || disc.depth > front->depth))
        front = &disc;
    return front == nullptr ? -1 : front->shade;
  };
  for (int k = 0; k < 2000; ++k) {
    const double u = random.uniform(-2.0, 22.0), v = random.uniform(-2.0, 22.0);
    EXPECT_EQ(in_front(seen, u, v), in_front(discs, u, v));
  }
}

TEST(VisibleDiscs, BearAStrayThatIsFarAway) {
  std::vector<Disc> discs{{1e7, -1e7, 1.0, 0.0, 0}};
  for (int k = 0; k < 100; ++k) discs.push_back({0.01 * k, 0.0, 1.0, 0.01 * k, k + 1});
  EXPECT_GE(visible_discs(discs, 0.05).size(), 2U);
}

}  // namespace
}  // namespace repose::test
