#include "engine/dynamics/integrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_scene.hpp"

namespace repose::test {
namespace {

/// A body with moments 1 : 2.5 : 3 (×1e-9), its own sphere far smaller than its reach, so that it is not a
/// ball.
Clump top_like_body() {
  Clump clump;
  clump.name = "top";
  clump.spheres = {{Vec3(1e-3, 0.0, 0.0), 2e-3}};
  clump.volume = 1e-7;
  clump.inertia = {1e-12, 2.5e-12, 3e-12};
  return clump;
}

Bodies one_body(const Clump& clump, const Vec3& w_body, const Quat& q = Quat::Identity()) {
  Bodies bodies(std::vector{clump}, 1000.0);
  NewBody body;
  body.orientation = q;
  body.angular_velocity = q * w_body;
  bodies.add(body);
  return bodies;
}

Vec3 momentum(const Bodies& b) { return {b.lx[0], b.ly[0], b.lz[0]}; }
double rotational_energy(const Bodies& b) { return 0.5 * momentum(b).dot(b.angular_velocity(0)); }

TEST(Integrate, MovesABodyAsThrowsAndKicksDo) {
  // v_{n+1} = v_n + Δt (F/m − g), x_{n+1} = x_n + Δt v_{n+1}: after n steps exactly
  // x = n Δt v_0 + Δt² n (n+1)/2 a.
  Bodies bodies = one_body(sphere_clump(2e-3), Vec3::Zero());
  bodies.motion[0].velocity[0] = 1.0;
  const double dt = 1e-4, m = bodies.motion[0].mass;
  const int n = 1000;
  for (int k = 0; k < n; ++k) {
    bodies.load[0].force[1] = 0.2 * m;
    integrate(bodies, {dt, RollingModel::type_c});
  }
  EXPECT_NEAR(bodies.x[0], 0.1, 1e-13);
  EXPECT_NEAR(bodies.y[0], dt * dt * 0.5 * n * (n + 1) * 0.2, 1e-14);
  EXPECT_NEAR(bodies.z[0], -dt * dt * 0.5 * n * (n + 1) * 9.81, 1e-13);
  EXPECT_NEAR(bodies.motion[0].velocity[2], -n * dt * 9.81, 1e-12);
}

TEST(Integrate, TurnsASphereByTheImpulseOfATorque) {
  Bodies bodies = one_body(sphere_clump(2e-3), {3.0, 0.0, 0.0});
  const double moment = 1.0 / bodies.inverse_i1[0];
  bodies.load[0].torque[1] = moment * 5.0;
  for (int k = 0; k < 10; ++k) integrate(bodies, {1e-2, RollingModel::type_c});
  EXPECT_NEAR(bodies.motion[0].w[0], 3.0, 1e-13);
  EXPECT_NEAR(bodies.motion[0].w[1], 0.5, 1e-13);
}

TEST(Integrate, KeepsTheAngularMomentumOfAFreeBodyToTheLastBit) {
  Bodies bodies = one_body(top_like_body(), {0.1, 20.0, 0.1});
  const Vec3 before = momentum(bodies);
  for (int k = 0; k < 100000; ++k) integrate(bodies, {1e-4, RollingModel::type_c});
  EXPECT_EQ(momentum(bodies), before);
  // ω follows from L and the orientation, whose norm and axes stay those of a rotation.
  EXPECT_NEAR(bodies.orientation(0).norm(), 1.0, 1e-14);
  const Mat3 turn = bodies.orientation(0).toRotationMatrix();
  const Vec3 inverse(bodies.inverse_i1[0], bodies.inverse_i2[0], bodies.inverse_i3[0]);
  const Vec3 w = turn * inverse.asDiagonal() * turn.transpose() * before;
  EXPECT_LT((w - bodies.angular_velocity(0)).norm(), 1e-9 * w.norm());
  for (int k = 0; k < 3; ++k) EXPECT_LT((Vec3(bodies.axes[0].column[k]) - turn.col(k)).norm(), 1e-14);
}

/// Orientation after 0.5 s of free rotation about the unstable axis, which tumbles over on the way.
Quat tumbled(double dt, double& energy_error) {
  Bodies bodies = one_body(top_like_body(), {0.5, 20.0, 0.5});
  const double before = rotational_energy(bodies);
  energy_error = 0.0;
  const int steps = static_cast<int>(std::lround(0.5 / dt));
  for (int k = 0; k < steps; ++k) {
    integrate(bodies, {dt, RollingModel::type_c});
    energy_error = std::max(energy_error, std::abs(rotational_energy(bodies) / before - 1.0));
  }
  return bodies.orientation(0);
}

TEST(Integrate, IsOfSecondOrderInFreeRotation) {
  double error_fine = 0.0, error_coarse = 0.0, unused = 0.0;
  const Quat exact = tumbled(1.25e-5, unused);
  const double coarse = tumbled(8e-4, error_coarse).angularDistance(exact);
  const double fine = tumbled(4e-4, error_fine).angularDistance(exact);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
  EXPECT_NEAR(error_coarse / error_fine, 4.0, 0.4);
}

TEST(Integrate, KeepsTheEnergyOfAFreeBodyBounded) {
  // No drift: the largest error of the second half is that of the first.
  Bodies bodies = one_body(top_like_body(), {0.5, 20.0, 0.5});
  const double before = rotational_energy(bodies);
  double halves[2] = {0.0, 0.0};
  for (int k = 0; k < 200000; ++k) {
    integrate(bodies, {2e-4, RollingModel::type_c});
    halves[k / 100000] = std::max(halves[k / 100000], std::abs(rotational_energy(bodies) / before - 1.0));
  }
  EXPECT_LT(halves[1], 1.02 * halves[0]);
  EXPECT_LT(halves[0], 1e-5);
}

TEST(Integrate, LetsASymmetricTopPrecessAtItsRate) {
  // I = (A, A, C): the axis turns about L at |L|/A.
  Clump top = top_like_body();
  top.inertia = {2e-12, 2e-12, 3e-12};
  Bodies bodies = one_body(top, {4.0, 0.0, 10.0});
  const double rate = momentum(bodies).norm() * bodies.inverse_i1[0];
  const Vec3 axis = momentum(bodies).normalized();
  const Vec3 start = bodies.orientation(0) * Vec3::UnitZ();
  const double time = 2.0 * kPi / rate;  // one turn
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) integrate(bodies, {time / steps, RollingModel::type_c});
  const Vec3 end = bodies.orientation(0) * Vec3::UnitZ();
  EXPECT_LT((end - start).norm(), 1e-6);
  EXPECT_NEAR(end.dot(axis), start.dot(axis), 1e-7);
}

TEST(Integrate, GivesEveryBodyWhatItWouldDoAlone) {
  // Thirteen bodies fill one block of lanes and part of the next.
  RandomStream random(41, 1);
  Bodies together(std::vector{top_like_body()}, 1000.0);
  std::vector<Bodies> alone;
  for (int k = 0; k < 13; ++k) {
    NewBody body;
    body.scale = random.uniform(0.5, 2.0);
    body.orientation = random.rotation();
    body.angular_velocity = 30.0 * Vec3(random.normal(), random.normal(), random.normal());
    body.velocity = Vec3(random.normal(), random.normal(), random.normal());
    together.add(body);
    alone.emplace_back(std::vector{top_like_body()}, 1000.0).add(body);
    alone.back().load[0].rolling = together.load[static_cast<std::size_t>(k)].rolling =
        k % 3 == 0 ? 1e-9 : 0.0;
  }
  for (int step = 0; step < 100; ++step) {
    integrate(together, {1e-4, RollingModel::type_a});
    for (Bodies& body : alone) integrate(body, {1e-4, RollingModel::type_a});
  }
  for (std::size_t k = 0; k < alone.size(); ++k) {
    EXPECT_EQ(together.position(k), alone[k].position(0));
    EXPECT_EQ(together.angular_velocity(k), alone[k].angular_velocity(0));
    EXPECT_EQ(together.orientation(k).coeffs(), alone[k].orientation(0).coeffs());
  }
}

TEST(RollingTypeA, SlowsASphereByItsConstantTorqueAndStopsIt) {
  Bodies bodies = one_body(sphere_clump(2e-3), {0.0, 8.0, 6.0});
  const double moment = 1.0 / bodies.inverse_i1[0], dt = 1e-3;
  bodies.load[0].rolling = moment * 100.0;  // 100 rad/s²
  for (int k = 0; k < 50; ++k) integrate(bodies, {dt, RollingModel::type_a});
  EXPECT_LT((bodies.angular_velocity(0) - 0.5 * Vec3(0.0, 8.0, 6.0)).norm(), 1e-12);
  for (int k = 0; k < 51; ++k) integrate(bodies, {dt, RollingModel::type_a});
  EXPECT_EQ(bodies.angular_velocity(0), Vec3::Zero());
}

TEST(RollingTypeA, LeavesABodyAtRestAtRest) {
  Bodies bodies = one_body(top_like_body(), Vec3::Zero());
  bodies.load[0].rolling = 1.0;
  const Quat before = bodies.orientation(0);
  for (int k = 0; k < 100; ++k) integrate(bodies, {1e-3, RollingModel::type_a});
  EXPECT_EQ(bodies.angular_velocity(0), Vec3::Zero());
  EXPECT_EQ(bodies.orientation(0).coeffs(), before.coeffs());
}

TEST(RollingTypeA, NeverTurnsTheRotationRoundNorAddsEnergy) {
  RandomStream random(43, 1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 w = 10.0 * Vec3(random.normal(), random.normal(), random.normal());
    const Quat q = random.rotation();
    Bodies bodies = one_body(top_like_body(), w, q);
    const double energy = rotational_energy(bodies);
    const double dt = 1e-11;  // the free rotation within the step is nothing beside the torque
    bodies.load[0].rolling = momentum(bodies).norm() / dt * std::pow(10.0, random.uniform(-3.0, 1.0));
    integrate(bodies, {dt, RollingModel::type_a});
    EXPECT_LE(rotational_energy(bodies), energy * (1.0 + 1e-12));
    EXPECT_GE(bodies.angular_velocity(0).dot(q * w), -1e-9 * w.squaredNorm());
    EXPECT_TRUE(bodies.angular_velocity(0).allFinite());
  }
}

}  // namespace
}  // namespace repose::test
