#include "sweep/cost_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/scene/scene_reader.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

Scene scene() { return read_scene(document_of(case_with(factorial()))); }

/// 0.05 kg of spheres of 8 mm and 2500 kg/m³ are 74.6 bodies; T = 0.05/5 + 1 s; with Δt = 1e-5 s and v/d of
/// the scene: 74.6 · 1.01 (100 000 + 200 v/d).
TEST(EstimatedWork, CountsStepsAndSearchesOfAllBodies) {
  Scene one = scene();
  one.numerics.time_step = 1e-5;
  const double bodies = 0.05 / (2500 * 4.0 / 3.0 * kPi * 0.004 * 0.004 * 0.004);
  const SlumpTest& test = one.test;
  const double fall = std::sqrt(test.pour_speed * test.pour_speed + 2.0 * kGravity * test.cylinder_height);
  const double work = estimated_work(one);
  EXPECT_NEAR(work, bodies * 1.01 * (1e5 + 200.0 * fall / 0.008), 1e-6 * work);
  one.particles.total_mass *= 3, one.test.pour_rate *= 3;
  EXPECT_NEAR(estimated_work(one) / work, 3.0, 1e-6);
}

/// Measured (3 kg of ore, packed, mean of 15 runs): CPU seconds of clumps of 12, 20, 30 and 60 spheres at 30
/// % of T_R and 0.001 of the stiffness, and of 8 at 0.01. 20 %: ratios of two that are told within 10 %.
TEST(EstimatedWork, TellsTheMeasuredCostOfFinerClumpsAndStifferContacts) {
  struct Measured {
    int spheres;
    double step, seconds;
  };
  const Scene of_spheres = scene();
  const auto work_of = [&](const Measured& run) {
    Scene one = of_spheres;
    Clump& shape = one.particles.shapes.front();
    shape.spheres.assign(static_cast<std::size_t>(run.spheres), shape.spheres.front());
    one.particles.shapes.resize(1);
    one.particles.size_classes = {{244e-9, 244e-9, 1.0}};
    one.test.filling = Filling::packing;
    one.test.cylinder_height = 0.3, one.test.pour_speed = 1.0;
    one.numerics.time_step = run.step;
    return estimated_work(one);
  };
  const Measured first{12, 3.05e-5, 32.0};
  for (const Measured& run :
       {Measured{20, 2.15e-5, 48.0}, {30, 2.00e-5, 71.0}, {60, 1.39e-5, 116.0}, {8, 1.54e-5, 39.0}})
    EXPECT_NEAR(work_of(run) / work_of(first) * first.seconds / run.seconds, 1.0, 0.2) << run.spheres;
}

TEST(EstimatedWork, TakesTheMeanOfTheSizeClasses) {
  Scene one = scene();
  one.numerics.time_step = 1e-7;  // searches do not count
  const double volume = one.particles.shapes[0].volume;
  const double work = estimated_work(one);
  one.particles.size_classes = {{volume, volume, 0.5}, {8 * volume, 8 * volume, 0.5}};
  EXPECT_NEAR(estimated_work(one) / work, 1 / 4.5, 1e-2);
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
