#include "engine/slump/still_angle.hpp"

#include <gtest/gtest.h>

#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

HeapMeasurement heap_of(double degrees_) {
  HeapMeasurement heap;
  heap.has_heap = true;
  heap.angle = radians(degrees_);
  return heap;
}

/// The reading at which a heap of these angles is at rest, from 1; 0 if never. None stands for no heap.
int rests_at(std::initializer_list<double> angles, double change) {
  StillAngle still(radians(change));
  int number = 0;
  for (const double angle : angles) {
    const double time = (1.0 + 1e-9) * StillAngle::kInterval * number++;
    EXPECT_TRUE(still.due(time));
    if (const auto since = still.look(time, angle > 0.0 ? heap_of(angle) : HeapMeasurement{})) {
      EXPECT_NEAR(*since, time - 0.1, 1e-8);
      return number;
    }
    EXPECT_FALSE(still.due(time + 0.9 * StillAngle::kInterval));
  }
  return 0;
}

TEST(StillAngle, NeedsSixReadingsWithinTheBound) {
  EXPECT_EQ(rests_at({30, 30, 30, 30, 30, 30}, 0.1), 6);
  EXPECT_EQ(rests_at({40, 33, 30, 30.05, 30, 30.09, 30, 30}, 0.1), 8);
}

TEST(StillAngle, SeesASlowCreep) {
  // 0.04° a reading: neighbours are within the bound, five of them are not.
  EXPECT_EQ(rests_at({30, 29.96, 29.92, 29.88, 29.84, 29.80, 29.76, 29.72, 29.68}, 0.1), 0);
  EXPECT_EQ(rests_at({30, 29.96, 29.92, 29.88, 29.84, 29.80}, 0.25), 6);
}

TEST(StillAngle, BeginsAgainWhereTheAngleCannotBeRead) {
  EXPECT_EQ(rests_at({30, 30, 30, 30, 30, -1, 30, 30, 30, 30, 30, 30}, 0.1), 12);
}

TEST(SlumpTestRun, EndsEarlyWhereTheAngleStandsStill) {
  // An energy that is never reached: without the bound on the angle the run times out.
  Scene scene = tiny_scene();
  scene.particles.shapes = {sphere_clump(2.5e-3)};  // enough of them for an angle
  scene.numerics.rest_energy_ratio = 1e-300;
  scene.numerics.stage_time_limit = 2.0;
  scene.numerics.rest_angle_change = radians(0.5);
  const RunOptions options;
  SlumpTestRun run(scene, 1, options);
  run.run();
  ASSERT_EQ(run.outcome(), Outcome::completed) << run.reason();
  EXPECT_GT(run.rest_time(), 0.0);
  EXPECT_LT(run.rest_time(), 1.5);
  const HeapMeasurement heap = measure_heap(run.simulation().snapshot(), scene.measure);
  // Until the energy criterion the angle moves by no more than a few bounds.
  scene.numerics.rest_energy_ratio = 1e-5;
  scene.numerics.rest_angle_change.reset();
  SlumpTestRun longer(scene, 1, options);
  longer.run();
  ASSERT_EQ(longer.outcome(), Outcome::completed) << longer.reason();
  const HeapMeasurement later = measure_heap(longer.simulation().snapshot(), scene.measure);
  EXPECT_NEAR(degrees(heap.angle), degrees(later.angle), 1.5);
}

}  // namespace
}  // namespace repose::test
