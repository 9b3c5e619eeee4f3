#include <gtest/gtest.h>

#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/stability/flat_clump.hpp"
#include "engine/stability/short_slump.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

TEST(FlatClump, HasTheParticlesMassAndTouchesWithAllItsSpheres) {
  const Scene scene = tiny_scene();
  const FlatClump flat = flat_clump(scene);
  const Clump& particle = scene.particles.shapes.front();
  EXPECT_EQ(flat.contacts, 9);
  EXPECT_NEAR(flat.mass, scene.particles.material.density * particle.volume, 1e-12);
  for (const Sphere& sphere : flat.clump.spheres) EXPECT_EQ(sphere.centre.z(), 0.0);
  EXPECT_LE(flat.clump.bounding_radius(), std::sqrt(2.0) * particle.bounding_radius());
}

// It rests on N springs: m g = N 4/3 Y* √R δ^{3/2}; falling on them it goes deeper. √(m/ΣK) at the deepest,
// which not all N share, lies between that of N springs there, halved for the rotation, and that at rest.
TEST(FlatClump, ItsStiffnessIsThatOfNSprings) {
  const Scene scene = tiny_scene();
  const FlatClump flat = flat_clump(scene);
  const FlatMotion sound = flat_motion(scene);
  const double R = flat.clump.smallest_radius(), N = flat.contacts;
  const double Y = Simulation(scene, 1.0).laws().wall_law.young;
  const double at_rest = std::pow(flat.mass * kGravity / (N * 4.0 / 3.0 * Y * std::sqrt(R)), 2.0 / 3.0);
  const auto time_at = [&](double overlap) {
    return std::sqrt(flat.mass / (N * 2.0 * Y * std::sqrt(R * overlap)));
  };
  EXPECT_GT(sound.deepest * R, at_rest);
  EXPECT_GT(sound.stiffness_time, 0.5 * time_at(sound.deepest * R));
  EXPECT_LT(sound.stiffness_time, time_at(at_rest));
}

// Far below the cliff the error is a few per cent (damping is of first order); at ten times √(m/ΣK), five
// times the limit of a spring, nothing holds.
TEST(FlatClump, IsStableFarBelowItsStiffnessTimeAndNotFarAbove) {
  const Scene scene = tiny_scene();
  const FlatMotion sound = flat_motion(scene);
  const Experiment experiment = flat_clump_experiment(scene, sound, {}, nullptr);
  const Probe fine = experiment(0.1 * sound.stiffness_time);
  EXPECT_TRUE(fine.stable());
  EXPECT_LT(std::abs(fine.energy_error), 0.1);
  EXPECT_FALSE(experiment(10.0 * sound.stiffness_time).stable());
}

TEST(ShortSlump, KeepsProportionsAndHasAboutAsManyBodiesAsAsked) {
  Scene scene = tiny_scene();
  scene.particles.total_mass = 8.0;
  scene.test.base_radius = 0.3;
  scene.test.cylinder_radius = 0.15;
  scene.test.cylinder_height = 0.5;
  const Scene small = shortened(scene, 200);
  const double mass = scene.particles.material.density * scene.particles.shapes.front().volume;
  EXPECT_NEAR(small.particles.total_mass / mass, 200.0, 1.0);
  EXPECT_NEAR(small.test.base_radius / small.test.cylinder_radius, 2.0, 1e-12);
  EXPECT_NEAR(small.test.cylinder_radius, 0.15 * std::cbrt(200.0 * mass / 8.0), 1e-12);
  EXPECT_NEAR(small.test.opening_speed,
              scene.test.opening_speed * std::sqrt(small.test.cylinder_radius / 0.15), 1e-12);
}

TEST(ShortSlump, ASceneOfFewerParticlesStaysAsItIs) {
  const Scene scene = tiny_scene();
  const Scene small = shortened(scene, 1000);
  EXPECT_EQ(small.particles.total_mass, scene.particles.total_mass);
  EXPECT_EQ(small.test.cylinder_radius, scene.test.cylinder_radius);
  EXPECT_EQ(small.test.cylinder_height, scene.test.cylinder_height);
}

TEST(ShortSlump, AnUnboundedBaseStaysUnbounded) {
  Scene scene = tiny_scene();
  scene.test.base_radius = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isinf(shortened(scene, 20).test.base_radius));
}

class ColumnOf : public ::testing::Test {
 protected:
  Scene scene = shortened(tiny_scene(), 40);
  SettledColumn column = settle_column(scene, 1, nullptr);
};

// The column's weight stands on its contacts: each of the n bodies on at least one, with no more than the
// whole weight, so that the elastic energy 2/5 F δ lies between that of n contacts that carry one body and
// that of 12 n that carry all.
TEST_F(ColumnOf, StandsAndHoldsTheEnergyOfItsWeight) {
  ASSERT_TRUE(column.sound()) << column.reason;
  const auto n = static_cast<double>(column.bodies.bodies.size());
  const double m = column.bodies.bodies.front().mass, R_eff = 0.5 * 5e-3;
  const double Y = Simulation(scene, 1.0).laws().pair_law.young;
  const auto energy_of_force = [&](double force) {
    return 0.4 * force * std::pow(force / (4.0 / 3.0 * Y * std::sqrt(R_eff)), 2.0 / 3.0);
  };
  EXPECT_GT(column.elastic_energy, n * energy_of_force(0.3 * m * kGravity));
  EXPECT_LT(column.elastic_energy, 12.0 * n * energy_of_force(n * m * kGravity));
  EXPECT_GT(column.largest_overlap, column.mean_overlap);
}

// √(m/ΣK) bounds what a step may be: a fourth is stable with every rolling model, four times is with none.
TEST_F(ColumnOf, IsStableFarBelowItsStiffnessTimeAndNotFarAbove) {
  for (const RollingModel model : {RollingModel::type_a, RollingModel::type_a_relative, RollingModel::type_c,
                                   RollingModel::type_c_undamped}) {
    scene.contact.rolling_model = model;
    const Experiment experiment = column_experiment(column, scene, {}, nullptr);
    EXPECT_TRUE(experiment(0.25 * column.stiffness_time).stable());
    EXPECT_FALSE(experiment(4.0 * column.stiffness_time).stable());
  }
}

TEST_F(ColumnOf, TheShortSlumpIsStableFarBelowAndNotFarAbove) {
  const Experiment experiment = slump_experiment(column, scene, 1, {}, nullptr);
  EXPECT_TRUE(experiment(0.25 * column.stiffness_time).stable());
  EXPECT_FALSE(experiment(8.0 * column.stiffness_time).stable());
}

TEST(SettledColumn, ThatIsTooSoftToStandSaysSo) {
  Scene scene = tiny_scene();
  scene.numerics.stiffness_scale = 1e-5;
  const SettledColumn column = settle_column(shortened(scene, 40), 1, nullptr);
  EXPECT_FALSE(column.sound());
  EXPECT_NE(column.reason, "");
}

TEST(SettledColumn, ThatIsStoppedIsInterrupted) {
  const std::atomic<bool> stop{true};
  const SettledColumn column = settle_column(shortened(tiny_scene(), 40), 1, &stop);
  EXPECT_TRUE(column.interrupted);
  EXPECT_FALSE(column.sound());
}

}  // namespace
}  // namespace repose::test
