#include "engine/dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "support/test_scene.hpp"

namespace repose::test {
namespace {

struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();  ///< about the common centre of mass
  double size = 0.0;            ///< Σ |L| of all bodies, what rounding is compared with
};

Momenta momenta_of(const Bodies& bodies) {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  Momenta sum;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const double m = bodies.motion[i].mass;
    mass += m;
    centre += m * bodies.position(i);
    sum.linear += m * bodies.velocity(i);
  }
  centre /= mass;
  const Vec3 drift = sum.linear / mass;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const Vec3 orbital =
        bodies.motion[i].mass * (bodies.position(i) - centre).cross(bodies.velocity(i) - drift);
    const Vec3 own(bodies.lx[i], bodies.ly[i], bodies.lz[i]);
    sum.angular += orbital + own;
    sum.size += orbital.norm() + own.norm();
  }
  return sum;
}

class ClosedCloud : public testing::TestWithParam<RollingModel> {};

TEST_P(ClosedCloud, KeepsItsMomentumAndAngularMomentum) {
  // Clumps of 2–6 spheres thrown at their common centre; gravity moves the cloud as a whole. Tolerance:
  // rounding of some 1e4 steps with some 1e2 contacts.
  RandomStream random(51, 1);
  std::vector<Clump> shapes;
  for (int k = 2; k <= 6; ++k) shapes.push_back(random_clump(random, k, 5e-3));
  const Scene scene = scene_of(shapes, kGlass, {0.6, 0.5, 0.2}, GetParam());
  const double dt = 1e-5;
  Simulation simulation(scene, dt);
  for (int k = 0; k < 60; ++k) {
    NewBody body;
    body.shape = k % 5;
    body.position =
        0.014 * Vec3(k % 4, (k / 4) % 4, k / 16) + 1e-3 * Vec3(random.uniform(), random.uniform(), 0.0);
    body.orientation = random.rotation();
    body.velocity = -20.0 * (body.position - Vec3(0.02, 0.02, 0.025)) + Vec3(0.0, 0.0, 1.0);
    body.angular_velocity = 50.0 * Vec3(random.normal(), random.normal(), random.normal());
    simulation.add(body);
  }
  const Momenta before = momenta_of(simulation.bodies());
  double mass = 0.0, contacts = 0.0;
  for (std::size_t i = 0; i < simulation.bodies().count; ++i) mass += simulation.bodies().motion[i].mass;
  const int steps = 8000;
  for (int k = 0; k < steps; ++k) {
    ASSERT_TRUE(simulation.step());
    for (std::size_t i = 0; i < simulation.bodies().count; ++i)
      contacts += simulation.bodies().load[i].contacts;
  }
  ASSERT_GT(contacts, 5e4);
  const Momenta after = momenta_of(simulation.bodies());
  const Vec3 expected = before.linear - Vec3(0.0, 0.0, mass * kGravity * dt * steps);
  EXPECT_LT((after.linear - expected).norm(), 1e-11 * mass);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-10 * before.size);
}

// type_a resists each body's own rotation from outside of the pair: it keeps no angular momentum, and is left
// out.
INSTANTIATE_TEST_SUITE_P(PairedRolling, ClosedCloud,
                         testing::Values(RollingModel::type_a_relative, RollingModel::type_c,
                                         RollingModel::type_c_undamped));

TEST(Simulation, MovesAClumpOfOneSphereAsTheSphere) {
  // The scene of the second run also holds a lump far away, so that orientations are followed there. Same
  // motion up to rounding, which bounces amplify: 1e-9 of the path after some ten bounces.
  const ContactParameters contact{0.7, 0.5, 0.1};
  RandomStream random(53, 1);
  const Clump lump = random_clump(random, 4, 5e-3);
  const auto run = [&](bool with_lump, RollingModel model) {
    const Scene scene =
        scene_of(with_lump ? std::vector{sphere_clump(4e-3), lump} : std::vector{sphere_clump(4e-3)}, kGlass,
                 contact, model);
    Simulation simulation(scene, 1e-5);
    simulation.walls = {floor_wall()};
    for (int k = 0; k < 3; ++k) {
      NewBody body;
      body.position = {0.003 * k, 0.001 * k, 0.01 + 0.01 * k};
      body.angular_velocity = {10.0, -40.0, 20.0};
      simulation.add(body);
    }
    for (int k = 0; k < 20000; ++k) simulation.step();
    return simulation.bodies();
  };
  for (const RollingModel model : {RollingModel::type_a, RollingModel::type_a_relative, RollingModel::type_c,
                                   RollingModel::type_c_undamped}) {
    const Bodies plain = run(false, model), oriented = run(true, model);
    EXPECT_FALSE(plain.oriented);
    EXPECT_TRUE(oriented.oriented);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT((plain.position(i) - oriented.position(i)).norm(), 1e-9);
      EXPECT_LT((plain.angular_velocity(i) - oriented.angular_velocity(i)).norm(), 1e-6);
    }
  }
}

TEST(Simulation, SeesThatAMotionHasDiverged) {
  const Scene scene = scene_of({sphere_clump(4e-3)}, kGlass, {0.5, 0.5, 0.1});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 2e3}) {
    Simulation simulation(scene, 1e-5);
    simulation.walls = {floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, 0.1};
    simulation.add(body);
    ASSERT_TRUE(simulation.step());
    body.position = {0.1, 0.0, 0.1};
    simulation.add(body);
    ASSERT_TRUE(simulation.step());
    body.position = {0.2, 0.0, 0.1};
    body.velocity = {bad / 1e-5, 0.0, 0.0};  // out of all bounds after one step
    simulation.add(body);
    bool going = true;
    for (int k = 0; k < 3 && going; ++k) going = simulation.step();
    EXPECT_FALSE(going) << bad;
  }
}

TEST(Simulation, SeesANumberThatIsNone) {
  // Two spheres at one place have no normal: both become NaN at once and nothing else ever moves.
  const Scene scene = scene_of({sphere_clump(4e-3)}, kGlass, {0.5, 0.5, 0.1});
  Simulation simulation(scene, 1e-5);
  NewBody body;
  simulation.add(body);
  simulation.add(body);
  bool going = true;
  for (int k = 0; k < 10 && going; ++k) going = simulation.step();
  EXPECT_FALSE(going && !simulation.bodies().position(0).allFinite());
}

TEST(Simulation, DoesNotDependOnWhatItHeldBefore) {
  // Bodies that have been removed leave no trace: the rest moves on as in a simulation that never held them.
  const Scene scene = scene_of({sphere_clump(4e-3)}, kGlass, {0.5, 0.5, 0.1}, RollingModel::type_c);
  const auto run = [&](bool with_others) {
    Simulation simulation(scene, 1e-5);
    simulation.walls = {floor_wall()};
    NewBody body;
    for (int k = 0; k < 5; ++k) {
      body.position = {0.002 * k, 0.0, 0.005 + 0.009 * k};
      simulation.add(body);
      if (!with_others) continue;
      NewBody far = body;
      far.position.y() += 0.1;
      simulation.add(far);
    }
    for (int k = 0; k < 3000; ++k) simulation.step();
    simulation.remove_if([&](std::size_t i) { return simulation.bodies().y[i] > 0.05; });
    for (int k = 0; k < 3000; ++k) simulation.step();
    return simulation.bodies();
  };
  const Bodies alone = run(false), left = run(true);
  ASSERT_EQ(alone.count, 5U);
  ASSERT_EQ(left.count, 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(alone.position(i), left.position(i));
    EXPECT_EQ(alone.angular_velocity(i), left.angular_velocity(i));
  }
}

TEST(Simulation, IsTheSameForAnyNumberOfThreadsAndAnySections) {
  // 60 clumps that collide in a narrow cylinder; some are added, some taken away, and helpers join on the
  // way.
  RandomStream random(7, 3);
  const std::vector<Clump> shapes{sphere_clump(3e-3), random_clump(random, 5, 5e-3)};
  for (const RollingModel model : {RollingModel::type_a, RollingModel::type_c}) {
    const Scene scene = scene_of(shapes, kGlass, {0.4, 0.5, 0.2}, model);
    const auto run = [&](int helpers, bool late, std::size_t section_bodies) {
      const auto crew = std::make_shared<Crew>(late ? 0 : helpers);
      std::vector<std::thread> late_helpers;
      Simulation simulation(scene, 1e-5, crew, section_bodies);
      simulation.walls = {floor_wall(), {Wall::Kind::closed_shell, 0.03, 0.0, 1.0, 0.0}};
      RandomStream places(9, 3);
      const auto add = [&](int k) {
        NewBody body;
        body.shape = k % 2;
        body.position = {0.012 * (k % 3 - 1), 0.012 * (k / 3 % 3 - 1), 0.01 + 0.011 * (k / 9)};
        body.orientation = places.rotation();
        body.velocity = 0.5 * Vec3(places.normal(), places.normal(), places.normal());
        simulation.add(body);
      };
      for (int k = 0; k < 54; ++k) add(k);
      for (int step = 0; step < 4000; ++step) {
        if (step == 1000 && late)
          for (int k = 0; k < helpers; ++k) late_helpers.emplace_back([&] { crew->help(); });
        if (step == 1500)
          simulation.remove_if([&](std::size_t i) { return simulation.bodies().id[i] % 5 == 2; });
        if (step == 2000)
          for (int k = 54; k < 60; ++k) add(k);
        EXPECT_TRUE(simulation.step());
      }
      crew->dismiss();
      for (std::thread& helper : late_helpers) helper.join();
      return std::pair(simulation.bodies(), simulation.ledger());
    };
    const auto [alone, booked_alone] = run(0, false, Section::kBodies);
    const auto [by_eights, booked] = run(0, false, 8);
    for (const bool late : {false, true})
      for (const int helpers : {1, 3}) {
        const auto [shared, booked_shared] = run(helpers, late, 8);
        ASSERT_EQ(shared.count, alone.count);
        for (std::size_t i = 0; i < alone.count; ++i) {
          EXPECT_EQ(shared.position(i), alone.position(i));
          EXPECT_EQ(shared.angular_velocity(i), alone.angular_velocity(i));
          EXPECT_EQ(shared.position(i), by_eights.position(i));
        }
        EXPECT_EQ(booked_shared.imbalance(), booked.imbalance());
        EXPECT_EQ(booked_shared.friction, booked.friction);
      }
    EXPECT_NEAR(booked.imbalance(), booked_alone.imbalance(), 1e-10 * booked_alone.turnover);  // rounding
  }
}

TEST(Simulation, LooksForContactsSeldomWhereNothingMoves) {
  // Spheres that have come to rest on the floor: a look every step would be 20000, one for each sphere that
  // settles from the last 0.1 mm/s on some dozens.
  const Scene scene = scene_of({sphere_clump(4e-3)}, kGlass, {0.3, 0.5, 0.1}, RollingModel::type_c);
  Simulation simulation(scene, 1e-5);
  simulation.walls = {floor_wall()};
  NewBody body;
  for (int k = 0; k < 9; ++k) {
    body.position = {0.0081 * (k % 3), 0.0081 * (k / 3), 0.0041};
    simulation.add(body);
  }
  for (int k = 0; k < 20000; ++k) simulation.step();
  const long looks = simulation.contacts().looks(), updates = simulation.contacts().updates();
  for (int k = 0; k < 20000; ++k) simulation.step();
  EXPECT_LT(simulation.contacts().looks() - looks, 200);
  EXPECT_LT(simulation.contacts().updates() - updates, 20);
}

}  // namespace
}  // namespace repose::test
