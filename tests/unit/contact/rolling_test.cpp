#include "engine/contact/rolling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/contact/random_contact.hpp"

namespace repose::test {
namespace {

LawParameters rolling_law(double mu, double eta = 0.3) {
  LawParameters law;
  law.young = 1e9;
  law.shear = 4e8;
  law.rolling = mu;
  law.rolling_damping = eta;
  return law;
}

RollingContact<double> contact_with(const Vec3& w_rel, double inertia_or_limit) {
  return {{0.0, 0.0, 1.0}, triple<double>(w_rel), 2e-3, 5e4, 3.0, 2.5, inertia_or_limit};
}

Triple<double> torque_of(const LawParameters& law, const RollingContact<double>& contact) {
  return constant_torque(law, contact, 1.0 / spin_or_one(contact.w_rel));
}

TEST(ConstantTorque, OpposesTheRelativeRotationWithTheElasticForce) {
  // μr |F_elastic| R* = 0.1 · 3 · 2 mm, along −ω_rel/|ω_rel| without its part along the normal.
  const Vec3 torque = vec3(torque_of(rolling_law(0.1), contact_with({3.0, 0.0, 4.0}, 1e9)));
  EXPECT_NEAR(torque.x(), -0.1 * 3.0 * 2e-3 * 0.6, 1e-18);
  EXPECT_EQ(torque.y(), 0.0);
  EXPECT_EQ(torque.z(), 0.0);
}

TEST(ConstantTorque, NeverExceedsWhatStopsTheRotation) {
  const double per_spin = 1e-6;
  const Vec3 torque = vec3(torque_of(rolling_law(0.1), contact_with({0.5, 0.0, 0.0}, per_spin)));
  EXPECT_NEAR(torque.x(), -per_spin * 0.5, 1e-20);
  EXPECT_EQ(vec3(torque_of(rolling_law(0.1), contact_with(Vec3::Zero(), per_spin))), Vec3::Zero());
}

TEST(RollingSpring, ClimbsWithTheAngleToItsLimit) {
  // type_c: k_r = 2.25 k_n μr² R*²; type_c_undamped: k_r = k_t R*². Both end at μr R* |F_n|.
  const double mu = 0.2, R = 2e-3, k = 5e4, F_n = 2.5, dt = 1e-4;
  const double limit = mu * R * F_n;
  const double stiffness[] = {2.25 * k * mu * mu * R * R, k * R * R};
  const LawParameters law = rolling_law(mu, 0.0);
  for (const bool damped : {true, false}) {
    const double k_r = stiffness[damped ? 0 : 1];
    const double w = 0.3 * limit / (k_r * dt);
    Triple<double> spring{0.0, 0.0, 0.0};
    for (int step = 1; step <= 6; ++step) {
      const RollingContact<double> contact = contact_with({w, 0.0, 7.0}, 1e-9);
      const Vec3 torque =
          vec3(damped ? rolling_spring<RollingModel::type_c>(law, contact, dt, spring)
                      : rolling_spring<RollingModel::type_c_undamped>(law, contact, dt, spring));
      EXPECT_NEAR(torque.x(), -std::min(0.3 * step, 1.0) * limit, 1e-12 * limit) << step;
      EXPECT_EQ(torque.z(), 0.0);  // torsion is not rolling
    }
  }
}

TEST(RollingSpring, IsViscousUntilFullyMobilised) {
  const double mu = 0.2, R = 2e-3, k = 5e4, F_n = 2.5, dt = 1e-7, I_r = 1e-9, eta = 0.3;
  const double k_r = 2.25 * k * mu * mu * R * R, limit = mu * R * F_n;
  const LawParameters law = rolling_law(mu, eta);
  Triple<double> spring{0.0, 0.0, 0.0};
  const Vec3 slow =
      vec3(rolling_spring<RollingModel::type_c>(law, contact_with({1.0, 0.0, 0.0}, I_r), dt, spring));
  EXPECT_NEAR(slow.x(), -k_r * dt - 2.0 * eta * std::sqrt(I_r * k_r), 1e-15);
  spring = {-limit, 0.0, 0.0};
  const Vec3 full =
      vec3(rolling_spring<RollingModel::type_c>(law, contact_with({1.0, 0.0, 0.0}, I_r), dt, spring));
  EXPECT_NEAR(full.x(), -limit, 1e-12 * limit);
}

TEST(RollingSpring, StaysInTheContactPlane) {
  RandomStream random(29, 1);
  const LawParameters law = rolling_law(0.2);
  for (int k = 0; k < 200; ++k) {
    RollingContact<double> contact = contact_with(random_vector(random, 3.0), 1e-9);
    const Vec3 n = random_vector(random, 1.0).normalized();
    contact.n = triple<double>(n);
    Triple<double> spring = triple<double>(random_vector(random, 1e-3));
    const Vec3 torque = vec3(rolling_spring<RollingModel::type_c>(law, contact, 1e-5, spring));
    EXPECT_NEAR(torque.dot(n), 0.0, 1e-15);
    EXPECT_NEAR(vec3(spring).dot(n), 0.0, 1e-15);
    EXPECT_LE(vec3(spring).norm(), 0.2 * 2e-3 * 2.5 * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace repose::test
