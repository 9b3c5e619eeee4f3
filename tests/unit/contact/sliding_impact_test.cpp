#include <gtest/gtest.h>

#include <cmath>

#include "engine/contact/contact_law.hpp"

namespace repose {
namespace {

/// Friction impulse of an impact that slides all the time, over its closed form μs (1+e) m v: Coulomb's law
/// holds at every instant. A sphere of 1 kg and 10 mm falls on a wall at 1 m/s and slides along it at 50 m/s,
/// without turning.
double friction_impulse_ratio(TangentialHistory history, double restitution) {
  constexpr double kMass = 1.0, kRadius = 0.01, kFriction = 0.3, kSpeed = 1.0;
  const ElasticSide side{1e9, 0.3};
  const LawParameters law =
      law_parameters(side, side, restitution, kFriction, 0.0, 0.0, NormalDamping::clamped, history);
  ContactHistory<double> memory{};
  const double contact_time =
      2.868 * std::pow(kMass * kMass / (kRadius * law.young * law.young * kSpeed), 0.2);
  const double dt = contact_time / 20000.0;
  double overlap = 0.0, v_normal = -kSpeed, v_tangent = 50.0, impulse = 0.0, rebound = 0.0;
  for (int step = 0; step < 200000; ++step) {
    overlap -= dt * v_normal;
    if (overlap <= 0.0) break;
    const ContactGeometry<double> geometry{{0.0, 0.0, 1.0}, overlap, kRadius, kMass, 0.0, 1.0 / kMass};
    const ContactSide<double> sphere{{v_tangent, 0.0, v_normal}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const ContactSide<double> wall{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const auto forces = contact_forces<RollingModel::type_a>(
        law, geometry, relative_motion(geometry.n, sphere, wall), {dt}, memory);
    v_normal += dt * forces.force.z / kMass;
    v_tangent += dt * forces.force.x / kMass;
    impulse -= dt * forces.force.x;
    rebound = v_normal;
  }
  return impulse / (kFriction * kMass * (kSpeed + rebound));
}

class SlidingImpact : public testing::TestWithParam<double> {};

// 0.5 %: friction builds up over the first steps of the contact, about 1e-3 of its impulse; the rest is the
// step.
TEST_P(SlidingImpact, TakesTheFrictionImpulseOfCoulombsLawWithBothHistories) {
  EXPECT_NEAR(friction_impulse_ratio(TangentialHistory::force, GetParam()), 1.0, 5e-3);
  EXPECT_NEAR(friction_impulse_ratio(TangentialHistory::displacement, GetParam()), 1.0, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, SlidingImpact, testing::Values(0.1, 0.5, 0.9));

}  // namespace
}  // namespace repose
