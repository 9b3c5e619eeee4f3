#include "engine/stability/stability_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/dynamics/time_step.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

MapOptions quick_options(int threads) {
  MapOptions options;
  options.scales = {1.0};
  options.bodies = 20;
  options.precision = 0.4;
  options.threads = threads;
  return options;
}

bool same(const Probe& a, const Probe& b) {
  return a.step == b.step && a.energy_error == b.energy_error && a.overlap == b.overlap &&
         a.failure == b.failure;
}

TEST(StabilityMap, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = tiny_scene();
  const StabilityMap one = map_stability(scene, quick_options(1)),
                     three = map_stability(scene, quick_options(3));
  ASSERT_EQ(one.rows.size(), 3U + 3U * 15U);
  ASSERT_EQ(one.rows.size(), three.rows.size());
  for (std::size_t k = 0; k < one.rows.size(); ++k) {
    EXPECT_TRUE(std::ranges::equal(one.rows[k].cliff.probes, three.rows[k].cliff.probes, same)) << k;
    EXPECT_EQ(one.rows[k].reason, three.rows[k].reason);
  }
  ASSERT_TRUE(one.recommendation && three.recommendation) << one.reason;
  EXPECT_EQ(one.recommendation->step, three.recommendation->step);
}

TEST(StabilityMap, RecommendsTheLeastCliffOfTheScenesOwnMethodOverTheMargin) {
  const Scene scene = tiny_scene();
  int last = 0, all = 0;
  MapOptions options = quick_options(0);
  options.on_progress = [&](int done, int of) { last = done, all = of; };
  const StabilityMap map = map_stability(scene, options);
  EXPECT_EQ(last, all);
  ASSERT_TRUE(map.recommendation) << map.reason;
  double least = 1.0;
  for (const MapRow& row : map.rows) {
    EXPECT_TRUE(row.measured()) << name_of(row.test) << ": " << row.reason;
    if (row.any_rolling ? row.method.integrator == Integrator::symplectic_euler
                        : row.method == method_of(scene))
      least = std::min(least, row.cliff.stable);
  }
  EXPECT_EQ(map.recommendation->largest_stable, least);
  EXPECT_EQ(map.recommendation->step, least / kSafetyMargin);
  EXPECT_EQ(map.recommendation->automatic, automatic_time_step(scene));
  EXPECT_EQ(map.recommendation->own, time_step(scene));
}

TEST(StabilityMap, TheScenesOwnStiffnessIsAlwaysThere) {
  MapOptions options = quick_options(0);
  options.scales = {0.1};
  const StabilityMap map = map_stability(tiny_scene(), options);
  const double own = tiny_scene().numerics.stiffness_scale;
  EXPECT_EQ(std::ranges::count(map.rows, own, &MapRow::stiffness_scale), 48);
  EXPECT_EQ(std::ranges::count(map.rows, own * 0.1, &MapRow::stiffness_scale), 48);
}

TEST(StabilityMap, ThatIsStoppedHoldsNothingThatIsNotDone) {
  const std::atomic<bool> stop{true};
  MapOptions options = quick_options(0);
  options.stop = &stop;
  const StabilityMap map = map_stability(tiny_scene(), options);
  EXPECT_TRUE(map.interrupted);
  EXPECT_TRUE(map.rows.empty());
  EXPECT_FALSE(map.recommendation);
}

}  // namespace
}  // namespace repose::test
