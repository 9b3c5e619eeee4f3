#include "engine/dynamics/energy_ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/scene/names.hpp"
#include "support/test_scene.hpp"

namespace repose::test {
namespace {

constexpr double kRadius = 2e-3;

double mass_of_sphere() { return kGlass.density * 4.0 / 3.0 * kPi * kRadius * kRadius * kRadius; }

NewBody moving_sphere(const Vec3& position, const Vec3& velocity) {
  NewBody body;
  body.position = position;
  body.velocity = velocity;
  return body;
}

void run(Simulation& simulation, double time) {
  const auto steps = static_cast<long>(std::round(time / simulation.dt()));
  for (long k = 0; k < steps; ++k) ASSERT_TRUE(simulation.step());
}

// A bounce takes ½ m v² (1 − e²), all of it in the damper. 200 steps a contact; 0.5 % for the first order of
// the damping in Δt.
TEST(EnergyLedger, GivesTheLossOfABounceToNormalDamping) {
  for (const double e : {0.3, 0.6, 0.9}) {
    Simulation simulation(scene_of({sphere_clump(kRadius)}, kGlass, {e, 0.0, 0.0}), 5e-7);
    simulation.walls = {floor_wall()};
    const double v = 2.0, m = mass_of_sphere();
    simulation.add(moving_sphere({0.0, 0.0, 1.01 * kRadius}, {0.0, 0.0, -v}));
    run(simulation, 8e-4);
    const EnergyLedger ledger = simulation.ledger();
    const double lost = 0.5 * m * v * v * (1.0 - e * e);
    EXPECT_NEAR(ledger.normal_damping, lost, 5e-3 * lost) << e;
    EXPECT_NEAR(ledger.relative_imbalance(), 0.0, 2e-3) << e;
    EXPECT_EQ(ledger.friction, 0.0);
    EXPECT_EQ(ledger.tangential_damping, 0.0);
  }
}

// A sphere that slides without rolling resistance loses μ m g times the path of its contact point,
// ∫ (u0 − 7/2 μ g t) dt up to t* = 2 u0/(7 μ g): u0²/(7 μ g) (slip to roll). 1 %: it sinks in and slides from
// the first contact on.
TEST(EnergyLedger, GivesTheLossOfSlidingToFriction) {
  Simulation simulation(scene_of({sphere_clump(kRadius)}, kGlass, {0.5, 0.3, 0.0}), 5e-6);
  simulation.walls = {floor_wall()};
  const double u0 = 0.2, m = mass_of_sphere();
  simulation.add(moving_sphere({0.0, 0.0, kRadius}, {u0, 0.0, 0.0}));
  run(simulation, 0.05);
  const EnergyLedger ledger = simulation.ledger();
  const double lost = m * u0 * u0 / 7.0;
  EXPECT_NEAR(ledger.friction + ledger.tangential_damping, lost, 1e-2 * lost);
  EXPECT_NEAR(ledger.relative_imbalance(), 0.0, 1e-3);
}

// Rolling resistance of type A takes all of a rolling sphere's energy.
TEST(EnergyLedger, GivesARollingSpheresEnergyToRollingResistance) {
  Simulation simulation(scene_of({sphere_clump(kRadius)}, kGlass, {0.5, 0.8, 0.1}), 5e-6);
  simulation.walls = {floor_wall()};
  const double u = 0.1, m = mass_of_sphere();
  NewBody body = moving_sphere({0.0, 0.0, kRadius}, {u, 0.0, 0.0});
  body.angular_velocity = {0.0, u / kRadius, 0.0};
  simulation.add(body);
  run(simulation, 0.5);
  const EnergyLedger ledger = simulation.ledger();
  const double kinetic = 0.7 * m * u * u;
  EXPECT_LT(ledger.kinetic, 1e-6 * kinetic);
  EXPECT_NEAR(ledger.rolling_resistance, kinetic, 2e-2 * kinetic);
  EXPECT_NEAR(ledger.relative_imbalance(), 0.0, 1e-3);
}

// A body that rests on a sphere of it beside its centre of mass, held upright by type A: in every step its
// weight turns it by m g d Δt/I and resistance stops it, which takes nothing, for nothing was put in. As if
// resistance followed on the weight it would take ½ Δt (m g d)²/I a second; 1 % of that for what is left of
// the fall's motion.
TEST(EnergyLedger, BooksNothingForSpinThatTypeAStopsInTheStepThatGivesIt) {
  const Clump clump = summed_clump({{Vec3::Zero(), kRadius}, {{kRadius, 0.0, kRadius}, kRadius / 3.0}});
  Simulation simulation(scene_of({clump}, kGlass, {0.3, 0.8, 0.2}), 1e-5);
  simulation.walls = {floor_wall()};
  const Vec3 foot = clump.spheres.front().centre;
  simulation.add(moving_sphere({0.0, 0.0, kRadius - foot.z()}, Vec3::Zero()));
  run(simulation, 0.3);
  const double before = simulation.ledger().rolling_resistance;
  run(simulation, 1.0);
  const double d = foot.x(), m = kGlass.density * clump.volume, I = kGlass.density * clump.inertia.minCoeff();
  const double followed = 0.5 * simulation.dt() * std::pow(m * kGravity * d, 2) / I;
  EXPECT_GT(std::abs(d), 0.02 * kRadius);
  EXPECT_LT(simulation.bodies().angular_velocity(0).norm(), 1e-9);
  EXPECT_NEAR(simulation.ledger().rolling_resistance, before, 1e-2 * followed);
}

// A wall that runs into a sphere at rest brings it to (1 + e) V; its work is the momentum times V.
TEST(EnergyLedger, CountsTheWorkOfAMovingWall) {
  const double e = 0.5, V = 1.0, m = mass_of_sphere();
  Scene scene = scene_of({sphere_clump(kRadius)}, kGlass, {e, 0.0, 0.0});
  Simulation simulation(scene, 5e-7);
  Wall wall = side_wall(1.02 * kRadius, kRadius);
  wall.velocity = {-V, 0.0, 0.0};
  simulation.walls = {wall};
  simulation.add(moving_sphere({0.0, 0.0, 0.0}, Vec3::Zero()));
  run(simulation, 1e-3);
  const EnergyLedger ledger = simulation.ledger();
  const double work = m * (1.0 + e) * V * V;
  EXPECT_NEAR(ledger.wall_work, work, 2e-3 * work);
  EXPECT_NEAR(ledger.imbalance(), 0.0, 2e-3 * work);
}

// What leaves takes its energy along.
TEST(EnergyLedger, StaysClosedWhereBodiesLeave) {
  Simulation simulation(scene_of({sphere_clump(kRadius)}, kGlass, {0.5, 0.5, 0.0}), 1e-5);
  simulation.add(moving_sphere({0.0, 0.0, 0.1}, {1.0, 0.0, 0.0}));
  simulation.add(moving_sphere({0.1, 0.0, 0.1}, {1.0, 2.0, 0.0}));
  run(simulation, 0.05);
  simulation.remove_if([](std::size_t i) { return i == 0; });
  run(simulation, 0.05);
  const EnergyLedger ledger = simulation.ledger();
  EXPECT_GT(ledger.removed, 0.25 * ledger.added);
  EXPECT_NEAR(ledger.relative_imbalance(), 0.0, 1e-3);  // the first half step of a body, g v Δt/2
}

struct Model {
  RollingModel rolling;
  TangentialHistory history;
  NormalDamping damping;
  Integrator integrator;
};

class LedgerOf : public ::testing::TestWithParam<Model> {
 protected:
  /// Clumps fall on each other on a plane and come to rest.
  [[nodiscard]] EnergyLedger heap(double dt) const {
    RandomStream random(3, 1);
    const Clump clump = random_clump(random, 4, 3e-3);
    Scene scene = scene_of({clump}, kGlass, {0.4, 0.5, 0.1}, GetParam().rolling);
    scene.contact.tangential_history = GetParam().history;
    scene.contact.normal_damping = GetParam().damping;
    scene.numerics.integrator = GetParam().integrator;
    Simulation simulation(scene, dt);
    simulation.walls = {floor_wall()};
    for (int k = 0; k < 12; ++k) {
      NewBody body;
      body.position = {2e-3 * (k % 3), 2e-3 * (k / 3 % 2), 5e-3 + 8e-3 * k};
      body.orientation = random.rotation();
      body.velocity = {0.0, 0.0, -0.5};
      simulation.add(body);
    }
    run(simulation, 0.25);
    return simulation.ledger();
  }
};

// 1 % of the energy put in at a step of about a tenth of T_R; every loss is a loss.
TEST_P(LedgerOf, ClosesForAHeapOfClumps) {
  const EnergyLedger ledger = heap(1e-6);
  EXPECT_LT(std::abs(ledger.relative_imbalance()), 0.01);
  EXPECT_LT(ledger.kinetic, 1e-2 * ledger.added);
  EXPECT_GT(ledger.normal_damping, 0.0);
  EXPECT_GT(ledger.tangential_damping, 0.0);
  EXPECT_GT(ledger.friction, 0.0);
  EXPECT_GT(ledger.rolling_resistance, 0.0);
  EXPECT_GE(ledger.elastic_normal, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Models, LedgerOf,
                         ::testing::Values(Model{RollingModel::type_a, TangentialHistory::force,
                                                 NormalDamping::with_tail, Integrator::symplectic_euler},
                                           Model{RollingModel::type_a, TangentialHistory::displacement,
                                                 NormalDamping::clamped, Integrator::symplectic_euler},
                                           Model{RollingModel::type_a_relative,
                                                 TangentialHistory::displacement, NormalDamping::with_tail,
                                                 Integrator::symplectic_euler},
                                           Model{RollingModel::type_c, TangentialHistory::force,
                                                 NormalDamping::with_tail, Integrator::symplectic_euler},
                                           Model{RollingModel::type_c_undamped, TangentialHistory::force,
                                                 NormalDamping::clamped, Integrator::symplectic_euler},
                                           Model{RollingModel::type_a, TangentialHistory::force,
                                                 NormalDamping::with_tail, Integrator::velocity_verlet}),
                         [](const ::testing::TestParamInfo<Model>& info) {
                           return std::string(choice_name(info.param.rolling)) + "_" +
                                  std::string(choice_name(info.param.history)) + "_" +
                                  std::string(choice_name(info.param.damping)) + "_" +
                                  std::string(choice_name(info.param.integrator));
                         });

// Plain Euler gives an elastic oscillation (a sphere that rests on a floor and is let go) energy at every
// step.
TEST(EnergyLedger, ShowsWhatExplicitEulerInvents) {
  Scene scene = scene_of({sphere_clump(kRadius)}, kGlass, {1.0, 0.0, 0.0});
  const auto imbalance = [&scene](Integrator integrator) {
    scene.numerics.integrator = integrator;
    Simulation simulation(scene, 2e-6);
    simulation.walls = {floor_wall()};
    simulation.add(moving_sphere({0.0, 0.0, 1.05 * kRadius}, {0.0, 0.0, -0.5}));
    run(simulation, 0.01);
    return simulation.ledger().relative_imbalance();
  };
  EXPECT_NEAR(imbalance(Integrator::symplectic_euler), 0.0, 1e-3);
  EXPECT_GT(imbalance(Integrator::explicit_euler), 0.01);
}

}  // namespace
}  // namespace repose::test
