#include "sweep/cost_model.hpp"

#include <gtest/gtest.h>

#include "engine/scene/scene_reader.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

Scene scene() { return read_scene(document_of(case_with(factorial()))); }

/// By the definition: work is proportional to bodies (mass over mass of a body) and to steps (T / Δt).
TEST(EstimatedWork, IsProportionalToStepsAndBodies) {
  Scene base = scene();
  base.test.pour_rate = 1e6;  // pouring takes no time
  const double work = estimated_work(base);
  Scene finer = base;
  *finer.numerics.time_step_fraction /= 2;
  EXPECT_NEAR(estimated_work(finer) / work, 2.0, 1e-12);
  Scene softer = base;
  softer.numerics.stiffness_scale = 0.01;
  EXPECT_NEAR(estimated_work(softer) / work, 0.1, 1e-12);
  Scene heavier = base;
  heavier.particles.total_mass *= 3;
  EXPECT_NEAR(estimated_work(heavier) / work, 3.0, 1e-6);
}

/// 0.05 kg of spheres of 8 mm and 2500 kg/m³ are 74.6 bodies; T = 0.05/5 + 1 s; with Δt = 1e-5 s: 74.6 · 101
/// 000.
TEST(EstimatedWork, CountsSphereUpdates) {
  Scene one = scene();
  one.numerics.time_step = 1e-5;
  const double bodies = 0.05 / (2500 * 4.0 / 3.0 * kPi * 0.004 * 0.004 * 0.004);
  EXPECT_NEAR(estimated_work(one), bodies * 101000, 1e-6 * bodies * 101000);
}

TEST(EstimatedWork, TakesTheMeanOfTheSizeClassesAndTheSmallestSphere) {
  Scene one = scene();
  const double volume = one.particles.shapes[0].volume;
  const double work = estimated_work(one);
  one.particles.size_classes = {{volume, volume, 0.5}, {8 * volume, 8 * volume, 0.5}};
  EXPECT_NEAR(estimated_work(one) / work, 1 / 4.5, 1e-9);  // fewer bodies, the same smallest sphere
  one.particles.size_classes = {{volume / 8, volume / 8, 1.0}};
  EXPECT_NEAR(estimated_work(one) / work, 16.0, 1e-9);  // eight times the bodies, twice the steps
}

TEST(CostModel, KnowsNothingBeforeTheFirstMeasurement) {
  const CostModel costs({1.0, 2.0});
  EXPECT_FALSE(costs.seconds(0).has_value());
  EXPECT_LT(costs.weight(0), costs.weight(1));
}

TEST(CostModel, ScalesTheWorkOfOtherPointsByWhatWasMeasured) {
  CostModel costs({1.0, 2.0, 4.0});
  costs.learn(0, 3.0);
  costs.learn(0, 5.0);
  EXPECT_DOUBLE_EQ(*costs.seconds(0), 4.0);
  EXPECT_DOUBLE_EQ(*costs.seconds(1), 8.0);
  costs.learn(1, 4.0);
  EXPECT_DOUBLE_EQ(*costs.seconds(1), 4.0);
  EXPECT_DOUBLE_EQ(*costs.seconds(2), 12.0);  // 12 s for 4 units of work
}

}  // namespace
}  // namespace repose::sweep
