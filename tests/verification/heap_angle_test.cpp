#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/measure/heap_measurement.hpp"
#include "support/synthetic_heap.hpp"

namespace repose {
namespace {

using testing::HeapRecipe;
using testing::RandomPacking;
using testing::SyntheticHeap;

/// Packings of three densities and three spreads of size.
const std::vector<RandomPacking>& packings() {
  static const std::vector<RandomPacking> made = [] {
    std::vector<RandomPacking> list;
    list.emplace_back(30.0, 20.0, 0.50, 0.10, 101);
    list.emplace_back(30.0, 20.0, 0.53, 0.20, 102);
    list.emplace_back(30.0, 20.0, 0.56, 0.30, 103);
    return list;
  }();
  return made;
}

/// Height of a cone that holds about so many bodies.
double apex_height(double angle, double diameter, double bodies) {
  const double volume = bodies * kPi / 6.0 * diameter * diameter * diameter / 0.53;
  const double slope = std::tan(angle);
  return std::cbrt(3.0 * volume * slope * slope / kPi);
}

/// A heap of 5–45° with a random selection of all that makes heaps hard to read.
HeapRecipe any_recipe(std::uint64_t seed, double bodies_low, double bodies_high) {
  RandomStream random(seed, 77);
  HeapRecipe recipe;
  recipe.seed = seed;
  recipe.angle = radians(random.uniform(5.0, 45.0));
  recipe.diameter = random.uniform(0.003, 0.008);
  recipe.apex_height = apex_height(recipe.angle, recipe.diameter, random.uniform(bodies_low, bodies_high));
  const double foot = recipe.apex_height / std::tan(recipe.angle);
  if (random.uniform() < 0.5) recipe.tip_rounding = random.uniform(0.05, 0.3);
  if (random.uniform() < 0.5) recipe.toe_height = random.uniform(0.02, 0.12);
  if (random.uniform() < 0.3) recipe.stretch = random.uniform(1.05, 1.3);
  if (random.uniform() < 0.5) {
    recipe.centre_x = random.uniform(-0.1, 0.1) * foot;
    recipe.centre_y = random.uniform(-0.1, 0.1) * foot;
  }
  if (random.uniform() < 0.3) recipe.base_radius = random.uniform(0.85, 1.0) * foot;
  if (random.uniform() < 0.5) {
    recipe.floor_strays = static_cast<int>(random.below(60));
    recipe.surface_strays = static_cast<int>(random.below(8));
    recipe.flying_strays = static_cast<int>(random.below(3));
  }
  if (random.uniform() < 0.3) recipe.spheres_per_body = 3 + static_cast<int>(random.below(8));
  if (random.uniform() < 0.5) recipe.cut = HeapRecipe::Cut::top;
  return recipe;
}

struct Tally {
  int heaps = 0;
  int unread = 0;
  int covered = 0;
  double mean_error = 0.0;   ///< of |α − true| [deg]
  double worst_error = 0.0;  ///< [deg]
  double bias = 0.0;         ///< mean of α − true [deg]

  void add(const SyntheticHeap& heap) {
    const HeapMeasurement measured = measure_heap(heap.snapshot);
    if (!measured.has_heap) {
      ++unread;
      return;
    }
    const double error = degrees(measured.angle - heap.true_angle());
    const double half_width = kAngleInterval95 * degrees(measured.standard_error);
    ++heaps;
    mean_error += (std::abs(error) - mean_error) / heaps;
    bias += (error - bias) / heaps;
    worst_error = std::max(worst_error, std::abs(error));
    if (std::abs(error) <= half_width) ++covered;
  }
  [[nodiscard]] double coverage() const { return static_cast<double>(covered) / heaps; }
  void record() const {
    ::testing::Test::RecordProperty("mean_error_deg", std::to_string(mean_error));
    ::testing::Test::RecordProperty("worst_error_deg", std::to_string(worst_error));
    ::testing::Test::RecordProperty("bias_deg", std::to_string(bias));
    ::testing::Test::RecordProperty("coverage", std::to_string(coverage()));
  }
};

// The bar: mean error ≤ 0.2°, worst ≤ 0.5°, and the 95 % interval holds the truth in 90–99 % of 200 heaps.
TEST(HeapAngle, TwoHundredSyntheticHeapsOfKnownAngle) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    tally.add(SyntheticHeap(packings()[seed % 3], any_recipe(seed, 5000.0, 9000.0)));
  }
  tally.record();
  EXPECT_EQ(tally.unread, 0);
  EXPECT_LE(tally.mean_error, 0.2);
  EXPECT_LE(tally.worst_error, 0.5);
  EXPECT_GE(tally.coverage(), 0.90);
  EXPECT_LE(tally.coverage(), 0.99);
}

}  // namespace
}  // namespace repose
