#include "engine/stability/elastic_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/stability/cliff.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

Scene scene_with(Integrator integrator) {
  Scene scene = tiny_scene();
  scene.numerics.integrator = integrator;
  return scene;
}

Probe probe_at(Integrator integrator, double share) {
  const Scene scene = scene_with(integrator);
  return elastic_pair_experiment(scene, {})(share * elastic_pair(scene).stiffness_time);
}

// 1e-3: at 1/50 of 1/ω a collision takes some 150 steps, of which the deepest is missed by less than half.
TEST(ElasticPair, ReachesTheOverlapOfHertzAndLosesNothing) {
  const Probe probe = probe_at(Integrator::symplectic_euler, 0.02);
  EXPECT_NEAR(probe.overlap, 1.0, 1e-3);
  EXPECT_NEAR(probe.energy_error, 0.0, 1e-3);
  EXPECT_TRUE(probe.stable());
}

// Leapfrog is of second order: half the step, a fourth of the error; the worst of 16 phases is not smooth,
// hence 15 %.
TEST(ElasticPair, ErrorOfSymplecticEulerFallsWithTheSquareOfTheStep) {
  const double ratio = probe_at(Integrator::symplectic_euler, 0.2).energy_error /
                       probe_at(Integrator::symplectic_euler, 0.1).energy_error;
  EXPECT_NEAR(ratio, 4.0, 0.6);
}

// Plain Euler gives a conservative motion Δt ∫ k v² dt. Over a collision of Hertz spheres,
//   ΔE/(½ m* v²) = 3 · 5/4 · 2/5 · 2 B(3/5, 3/2) v Δt/δ_max,
// with the next order of ΔE left out: 5 % at ΔE = 2 to 5 %.
TEST(ElasticPair, ExplicitEulerGainsWhatItsFirstOrderSays) {
  const Scene scene = scene_with(Integrator::explicit_euler);
  const ElasticPair pair = elastic_pair(scene);
  for (const double share : {0.008, 0.016}) {
    const double dt = share * pair.stiffness_time;
    const double gain = 3.0 * std::beta(0.6, 1.5) * pair.speed * dt / pair.deepest;
    const Probe probe = elastic_pair_experiment(scene, {})(dt);
    EXPECT_GT(probe.energy_error, 0.0);
    EXPECT_NEAR(probe.energy_error, gain, 0.05 * gain) << share;
  }
}

TEST(ElasticPair, ExplicitEulerGainsEnergyAtEveryStep) {
  for (double share = 0.002; share < 0.5; share *= 2.0)
    EXPECT_GT(probe_at(Integrator::explicit_euler, share).energy_error, 0.0) << share;
}

// Leapfrog on a spring is stable below 2/ω. A Hertz contact is as stiff as ω² m* only at its deepest, but the
// error is already a fourth at about 1.3/ω; beyond 2/ω nothing is left of the collision.
TEST(ElasticPair, CliffOfSymplecticEulerLiesBelowTheLimitOfASpring) {
  const Scene scene = scene_with(Integrator::symplectic_euler);
  const double unit = elastic_pair(scene).stiffness_time;
  const Cliff cliff = find_cliff(elastic_pair_experiment(scene, {}), {unit / 16.0, 0.05});
  EXPECT_GT(cliff.stable, 1.0 * unit);
  EXPECT_LT(cliff.stable, 2.0 * unit);
  EXPECT_EQ(cliff.failure, Failure::energy);
}

// Without damping, velocity Verlet moves as symplectic Euler, to rounding.
TEST(ElasticPair, VelocityVerletWithoutDampingIsSymplecticEuler) {
  EXPECT_NEAR(probe_at(Integrator::velocity_verlet, 0.3).energy_error,
              probe_at(Integrator::symplectic_euler, 0.3).energy_error, 1e-9);
}

// Everything scales: 100 times softer, 10^0.8 times as long a collision (t_c ~ Y*^(-2/5)), the same error.
TEST(ElasticPair, ErrorDependsOnTheShareOfTheStepAlone) {
  Scene soft = tiny_scene();
  soft.numerics.stiffness_scale *= 0.01;
  const ElasticPair stiff_pair = elastic_pair(tiny_scene()), soft_pair = elastic_pair(soft);
  EXPECT_NEAR(soft_pair.contact_time / stiff_pair.contact_time, std::pow(100.0, 0.4), 1e-9);
  const double error = elastic_pair_experiment(soft, {})(0.5 * soft_pair.stiffness_time).energy_error;
  EXPECT_NEAR(error, probe_at(Integrator::symplectic_euler, 0.5).energy_error, 1e-6);
}

}  // namespace
}  // namespace repose::test
