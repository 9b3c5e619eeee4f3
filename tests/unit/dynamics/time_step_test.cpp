#include "engine/dynamics/time_step.hpp"
#include "engine/scene/particle_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_scene.hpp"

namespace repose::test {
namespace {

/// Whether an oscillator ẍ = −x − 2 ζ ẋ, stepped by phases Δt as integrate() does, is quiet in the end.
bool comes_to_rest(Integrator integrator, double zeta, double dt) {
  double x = 1.0, v = 0.0, a_before = 0.0;
  for (int k = 0; k < 20000 && std::abs(x) < 1e6; ++k) {
    const double seen = integrator == Integrator::velocity_verlet ? v + 0.5 * dt * a_before : v;
    const double a = -x - 2.0 * zeta * seen;
    if (integrator == Integrator::explicit_euler) x += dt * v;
    v += dt * a;
    if (integrator != Integrator::explicit_euler) x += dt * v;
    a_before = a;
  }
  return std::abs(x) < 1.0;
}

// 1 % on both sides; above, the recurrence grows by at least 1.01^20000 or e^(0.01 ζ …) within the steps
// taken.
TEST(LargestStablePhase, IsWhereARecurrenceBeginsToGrow) {
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::explicit_euler})
    for (const double zeta : {0.05, 0.3, 0.8, 1.0, 1.6}) {
      const double phase = largest_stable_phase(integrator, zeta);
      EXPECT_TRUE(comes_to_rest(integrator, zeta, 0.99 * phase))
          << static_cast<int>(integrator) << " " << zeta;
      EXPECT_FALSE(comes_to_rest(integrator, zeta, 1.01 * phase))
          << static_cast<int>(integrator) << " " << zeta;
    }
}

TEST(LargestStablePhase, OfASpringWithoutDamperIsTwoButForPlainEuler) {
  EXPECT_EQ(largest_stable_phase(Integrator::symplectic_euler, 0.0), 2.0);
  EXPECT_EQ(largest_stable_phase(Integrator::velocity_verlet, 0.0), 2.0);
  EXPECT_EQ(largest_stable_phase(Integrator::explicit_euler, 0.0), kElasticEuler);
}

Scene scene_with(double restitution, Integrator integrator = Integrator::symplectic_euler) {
  Scene scene = scene_of({sphere_clump(2e-3)}, kGlass, {restitution, 0.5, 0.1});
  scene.test.cylinder_height = 0.2;
  scene.numerics.integrator = integrator;
  return scene;
}

TEST(AutomaticTimeStep, ShrinksWithDampingAndWithTheIntegrator) {
  const double lively = automatic_time_step(scene_with(0.9)), dead = automatic_time_step(scene_with(0.05));
  EXPECT_LT(dead, 0.5 * lively);
  EXPECT_LT(automatic_time_step(scene_with(0.3, Integrator::velocity_verlet)),
            0.7 * automatic_time_step(scene_with(0.3)));
  EXPECT_LT(automatic_time_step(scene_with(1.0, Integrator::explicit_euler)),
            0.05 * automatic_time_step(scene_with(1.0)));
  Scene wall = scene_with(0.9);
  wall.contact.particle_wall.restitution = 0.05;
  EXPECT_EQ(automatic_time_step(wall), dead) << "the more damped kind of contact decides";
}

// T_R ~ R √(ρ/G), and so does a collision but for the speed of a fall (t_c ~ G^(−2/5)).
TEST(AutomaticTimeStep, FollowsTheStiffness) {
  Scene soft = scene_with(0.3);
  soft.numerics.stiffness_scale = 0.01;
  EXPECT_NEAR(automatic_time_step(soft) / automatic_time_step(scene_with(0.3)), std::pow(100.0, 0.4), 1e-9);
}

// The same body as one sphere and as seven in one place: the softer, the deeper they sink in and the more
// touch.
TEST(AutomaticTimeStep, KnowsThatManySpheresOfASoftClumpTouchAtOnce) {
  Clump seven = sphere_clump(2e-3);
  seven.spheres.resize(7, seven.spheres.front());
  const auto ratio = [&](double stiffness) {
    Scene one = scene_with(0.3), many = scene_with(0.3);
    many.particles.shapes = {seven};
    one.numerics.stiffness_scale = many.numerics.stiffness_scale = stiffness;
    return automatic_time_step(many) / automatic_time_step(one);
  };
  EXPECT_NEAR(ratio(1e4), 1.0, 0.05);
  EXPECT_LT(ratio(1.0), ratio(1e4));
  EXPECT_LT(ratio(1e-2), 0.8);
}

TEST(EquivalentSphere, HasTheVolumeOfTheSmallestParticle) {
  Scene scene = scene_of({sphere_clump(3e-3), sphere_clump(2e-3)}, kGlass, {0.5, 0.5, 0.1});
  EXPECT_NEAR(equivalent_sphere(scene.particles), 2e-3, 1e-15);
  scene.particles.size_classes = {{1e-9, 4e-9, 1.0}};
  EXPECT_NEAR(equivalent_sphere(scene.particles), std::cbrt(0.75e-9 / kPi), 1e-15);
}

}  // namespace
}  // namespace repose::test
