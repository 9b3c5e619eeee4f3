#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/led_contact.hpp"
#include "unit/contact/random_contact.hpp"

namespace repose::test {
namespace {

using reference::ContactMaterial;

ContactMaterial undamped(double friction, TangentialHistory history) {
  ContactMaterial m;
  m.a = m.b = {1e9, 0.3};
  m.e = 1.0;
  m.friction = friction;
  m.history = history;
  return m;
}

class TangentialSpringOf : public testing::TestWithParam<TangentialHistory> {};

TEST_P(TangentialSpringOf, GrowsLinearlyAndEndsAtTheFrictionLimit) {
  const ContactMaterial m = undamped(0.4, GetParam());
  LedContact contact(law_of(m));
  const double overlap = 1e-5, a = std::sqrt(1e-3 * overlap);
  contact.lead(overlap, Vec3::Zero(), 1);
  const double F_n = contact.force().z(), S_t = 8.0 * m.G_eff() * a;
  const double slip = 0.4 * F_n / S_t;
  contact.lead(overlap, {0.5 * slip, 0.0, 0.0}, 10);
  EXPECT_NEAR(contact.force().x(), -0.5 * 0.4 * F_n, 1e-12 * F_n);
  contact.lead(overlap, {3.0 * slip, 0.0, 0.0}, 10);
  EXPECT_NEAR(contact.force().x(), -0.4 * F_n, 1e-12 * F_n);
  // The spring kept no more than the limit: going back by one slip length takes all of it away again.
  contact.lead(overlap, {2.0 * slip, 0.0, 0.0}, 10);
  EXPECT_NEAR(contact.force().x(), 0.0, 1e-12 * F_n);
}

INSTANTIATE_TEST_SUITE_P(BothHistories, TangentialSpringOf,
                         testing::Values(TangentialHistory::force, TangentialHistory::displacement));

TEST(TangentialForce, TakesWhatIsSheareddAtOneOverlapBackAtAnother) {
  // Load the contact, shear it, unload it, shear it back, close the cycle. Stored displacement returns more
  // than it took when sheared at the small overlap and back at the large one; stored force never does,
  // whichever way round.
  const double small = 2e-6, large = 1e-5, slide = 2e-8;
  const auto cycle = [&](TangentialHistory history, double sheared_at, double back_at, double& spent) {
    LedContact contact(law_of(undamped(10.0, history)));
    double work = contact.lead(sheared_at, Vec3::Zero(), 4000);
    work += contact.lead(sheared_at, {slide, 0.0, 0.0}, 4000);
    work += contact.lead(back_at, {slide, 0.0, 0.0}, 4000);
    work += contact.lead(back_at, Vec3::Zero(), 4000);
    work += contact.lead(0.0, Vec3::Zero(), 4000);
    spent = contact.spent();
    return work;
  };
  double spent = 0.0;
  EXPECT_GT(cycle(TangentialHistory::force, large, small, spent), -1e-9 * spent);
  EXPECT_GT(cycle(TangentialHistory::force, small, large, spent), -1e-9 * spent);
  EXPECT_LT(cycle(TangentialHistory::displacement, small, large, spent), -1e-6 * spent);
}

TEST(TangentialForce, NeverCreatesEnergyInAnyClosedPath) {
  // Random closed paths of loading, unloading, sticking and sliding in two directions. The trapezium rule
  // adds up the work of piecewise linear springs exactly and that of the Hertz spring to 1e-9 of the work.
  RandomStream random(17, 3);
  for (int path = 0; path < 200; ++path) {
    LedContact contact(law_of(undamped(random.uniform(0.05, 2.0), TangentialHistory::force)));
    double work = 0.0;
    const int corners = 3 + static_cast<int>(random.below(5));
    for (int k = 0; k < corners; ++k) {
      const double overlap = 1e-5 * std::pow(10.0, random.uniform(-1.5, 0.0));
      work += contact.lead(overlap, {random.uniform(-5e-6, 5e-6), random.uniform(-5e-6, 5e-6), 0.0}, 800);
    }
    work += contact.lead(0.0, Vec3::Zero(), 800);
    EXPECT_GT(work, -1e-9 * contact.spent()) << path;
  }
}

TEST(TangentialForce, NeverExceedsTheLimitNorPullsAlongTheMotionWhileSliding) {
  RandomStream random(19, 4);
  int sliding = 0;
  for (int k = 0; k < 3000; ++k) {
    const ContactMaterial material = random_material(random, RollingModel::type_a);
    const RandomContact contact = random_contact(random, material);
    EngineContact<double> c = engine_contact(contact, RollingModel::type_a);
    const ContactForces<double> f = contact_forces<RollingModel::type_a>(
        law_of(material), c.geometry, relative_motion(c.geometry.n, c.i, c.j), {1e-7}, c.history);
    const Vec3 tangent = reference::tangent_part(vec3(f.force), contact.contact.n);
    const double limit = material.friction * std::abs(f.F_n);
    EXPECT_LE(tangent.norm(), limit * (1.0 + 1e-9) + 1e-12 * std::abs(f.F_n));
    // A sliding contact without a spring of its own resists the motion.
    c = engine_contact(contact, RollingModel::type_a);
    c.history.tangential = {};
    const ContactForces<double> fresh = contact_forces<RollingModel::type_a>(
        law_of(material), c.geometry, relative_motion(c.geometry.n, c.i, c.j), {1e-7}, c.history);
    const Vec3 v =
        reference::tangent_part(contact.i.at_contact() - contact.j.at_contact(), contact.contact.n);
    const Vec3 held = reference::tangent_part(vec3(fresh.force), contact.contact.n);
    EXPECT_LE(held.dot(v), 1e-12 * held.norm() * v.norm());
    sliding += tangent.norm() > 0.999 * limit;
  }
  EXPECT_GT(sliding, 300);
}

/// Two bodies that turn together as one, with a stored spring and no motion at their contact: the spring
/// keeps its place in their frame.
Vec3 spring_after_turning(const Vec3& w, const Vec3& n0, const Vec3& spring0, int steps) {
  const double dt = 1.0 / steps;
  Triple<double> spring = triple<double>(spring0);
  for (int k = 1; k <= steps; ++k) {
    const Vec3 n = Eigen::AngleAxisd(w.norm() * k * dt, w.normalized()) * n0;
    const auto turned = turned_spring(spring, triple<double>(n), dt * w.dot(n));
    spring = turned.with_old_length(1.0 / turned.after);
  }
  return vec3(spring);
}

TEST(TangentialSpring, TurnsWithThePair) {
  RandomStream random(23, 5);
  for (int k = 0; k < 20; ++k) {
    const Vec3 n = random_vector(random, 1.0).normalized();
    const Vec3 spring = reference::tangent_part(random_vector(random, 1.0), n);
    const Vec3 w = 2.0 * kPi * random_vector(random, 1.0).normalized();  // one turn
    const double coarse = (spring_after_turning(w, n, spring, 500) - spring).norm();
    const double fine = (spring_after_turning(w, n, spring, 1000) - spring).norm();
    // After a whole turn the spring is back, up to half the angle of a step per radian (2π · 2π/1000 / 2 =
    // 2e-2), and what is missing falls at least with Δt; the length is kept exactly.
    EXPECT_LT(fine, 2e-2 * spring.norm());
    EXPECT_GT(coarse / fine, 1.9);
    EXPECT_NEAR(spring_after_turning(w, n, spring, 1000).norm() / spring.norm(), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace repose::test
