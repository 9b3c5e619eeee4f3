#include "engine/dynamics/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.hpp"

namespace repose {
namespace {

/// All pairs of a grid, each once, sorted.
std::vector<BodyPair> near_pairs(const SearchSpheres& spheres, double skin) {
  const CellGrid grid(spheres, skin);
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < spheres.size(); ++i) grid.append_pairs_of(i, pairs);
  return pairs;
}

struct Cloud {
  std::vector<double> x, y, z, radius;
  void add(double px, double py, double pz, double r) {
    x.push_back(px), y.push_back(py), z.push_back(pz), radius.push_back(r);
  }
  [[nodiscard]] SearchSpheres spheres() const { return {x, y, z, radius}; }
  [[nodiscard]] std::vector<BodyPair> brute_force(double skin) const {
    std::vector<BodyPair> pairs;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double dx = x[i] - x[j], dy = y[i] - y[j], dz = z[i] - z[j];
        const double reach = radius[i] + radius[j] + skin;
        if (dx * dx + dy * dy + dz * dz < reach * reach)
          pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    return pairs;
  }
};

TEST(NearPairs, AreThoseOfBruteForceForSizesOfOneTwentieth) {
  RandomStream random(1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    Cloud cloud;
    const double box = random.uniform(0.02, 0.1);
    for (int k = 0; k < 400; ++k)
      cloud.add(random.uniform(-box, box), random.uniform(-box, box), random.uniform(0.0, 2.0 * box),
                5e-4 * std::pow(20.0, random.uniform()));
    const auto expected = cloud.brute_force(1e-3);
    ASSERT_GT(expected.size(), 10U);
    EXPECT_EQ(near_pairs(cloud.spheres(), 1e-3), expected);
  }
}

TEST(NearPairs, OfSomeSpheresAreThoseOfAllWithThese) {
  RandomStream random(3, 1);
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    Cloud cloud;
    for (int k = 0; k < 300; ++k)
      cloud.add(random.uniform(0.0, 0.05), random.uniform(0.0, 0.05), random.uniform(0.0, 0.05), 3e-3);
    std::vector<std::uint8_t> flags;
    for (int k = 0; k < 300; ++k) flags.push_back(random.uniform() < share ? 1 : 0);
    std::vector<BodyPair> expected = cloud.brute_force(5e-4);
    std::erase_if(expected, [&](const BodyPair& pair) {
      return flags[static_cast<std::size_t>(pair.i)] == 0 && flags[static_cast<std::size_t>(pair.j)] == 0;
    });
    const SearchSpheres spheres = cloud.spheres();
    const CellGrid grid(spheres, 5e-4);
    std::vector<BodyPair> pairs, above;
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i] != 0) grid.append_pairs_of(i, flags, pairs, above);
    pairs.insert(pairs.end(), above.begin(), above.end());
    std::ranges::sort(pairs);
    EXPECT_EQ(pairs, expected) << share;
  }
}

TEST(NearPairs, FindWhatStandsFarFromTheRest) {
  RandomStream random(2, 1);
  Cloud cloud;
  for (int k = 0; k < 200; ++k)
    cloud.add(random.uniform(0.0, 0.05), random.uniform(0.0, 0.05), random.uniform(0.0, 0.05), 3e-3);
  cloud.add(900.0, -800.0, 0.0, 3e-3);
  cloud.add(900.0, -800.0, 5e-3, 3e-3);  // a pair of strays
  cloud.add(-700.0, 10.0, 500.0, 3e-3);
  EXPECT_EQ(near_pairs(cloud.spheres(), 5e-4), cloud.brute_force(5e-4));
}

TEST(NearPairs, TakeEqualPlacesFlatSetsAndSmallSets) {
  Cloud cloud;
  EXPECT_TRUE(near_pairs(cloud.spheres(), 1e-3).empty());
  cloud.add(0.0, 0.0, 0.0, 1e-3);
  EXPECT_TRUE(near_pairs(cloud.spheres(), 1e-3).empty());
  cloud.add(0.0, 0.0, 0.0, 1e-3);  // the same place
  cloud.add(0.0, 0.0, 0.0, 2e-3);
  EXPECT_EQ(near_pairs(cloud.spheres(), 0.0), cloud.brute_force(0.0));
  for (int k = 0; k < 30; ++k) cloud.add(2e-3 * k, 0.0, 0.0, 1.01e-3);  // a row
  EXPECT_EQ(near_pairs(cloud.spheres(), 1e-4), cloud.brute_force(1e-4));
}

}  // namespace
}  // namespace repose
