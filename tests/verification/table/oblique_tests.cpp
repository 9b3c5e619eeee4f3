#include "verification/table/oblique_tests.hpp"

#include "reference/plain_contact.hpp"

namespace repose::verification {

namespace {

/// Surface speed of the first body at the contact with the other.
double slip_of(const Impact& impact, const Vec3& velocity, const Vec3& spin, const Vec3& other_velocity,
               const Vec3& other_spin) {
  double slip = velocity.y() + spin.z() * impact.body.spheres.front().radius;
  if (impact.other) slip -= other_velocity.y() - other_spin.z() * impact.other->spheres.front().radius;
  return slip;
}

Oblique incidence(const Impact& impact) {
  Oblique before;
  before.incident_tangential = impact.velocity.y() - impact.other_velocity.y();
  before.incident_slip =
      slip_of(impact, impact.velocity, impact.spin, impact.other_velocity, impact.other_spin);
  return before;
}

reference::PlanarImpact planar_impact(const Impact& impact) {
  const Material& other = impact.other ? impact.material : impact.wall;
  reference::ContactMaterial law{{impact.material.shear_modulus, impact.material.poisson_ratio},
                                 {other.shear_modulus, other.poisson_ratio}};
  law.e = impact.contact.restitution;
  const bool clamped = impact.damping == NormalDamping::clamped;
  reference::PlanarImpact planar;
  planar.normal = {impact.Y_eff(), impact.R_eff(), impact.m_eff(),
                   reference::gamma_for_rebound(law.e, clamped), clamped};
  planar.G_eff = law.G_eff();
  planar.gamma_t = 2.0 * std::sqrt(5.0 / 6.0) * law.beta();
  planar.friction = impact.contact.static_friction;
  planar.radius_i = impact.body.spheres.front().radius;
  planar.mobility = 1.0 / impact.m_eff();
  planar.turning_i = 1.0 / (impact.material.density * impact.body.inertia.x());
  if (impact.other) {
    planar.radius_j = impact.other->spheres.front().radius;
    planar.turning_j = 1.0 / (impact.material.density * impact.other->inertia.x());
  }
  return planar;
}

double slip_change(const Oblique& o) { return o.slip - o.incident_slip; }

/// Test 4: a sphere on a rigid wall, 3.9 m/s at 5–85° from the normal: what is left of the tangential speed,
/// and the spin.
std::vector<ObliqueTest> angles_on_wall() {
  const double mu = 0.092, e = 0.98, v = 3.9, R = 2.5e-3;
  const auto slides = [=](double angle) { return std::tan(radians(angle)) > 3.5 * mu * (1.0 + e); };
  ObliqueTest speed;
  speed.name = "4: oblique on a wall, aluminium oxide";
  speed.file = "test_4_tangential";
  speed.quantity = "tangential restitution";
  speed.x_label = "angle from the normal [degrees]";
  speed.y_label = "tangential restitution e_t [-]";
  for (double angle = 5.0; angle < 86.0; angle += 5.0) speed.points.push_back(angle);
  speed.impact = [=](double angle) {
    Impact impact;
    impact.body = sphere_clump(R);
    impact.material = elastic_material(380e9, 0.23, 4000.0);
    impact.contact = {e, mu, 0.0};
    impact.velocity = {v * std::cos(radians(angle)), v * std::sin(radians(angle)), 0.0};
    return impact;
  };
  speed.y = [](const Oblique& o) { return o.tangential / o.incident_tangential; };
  speed.change = [](const Oblique& o) { return 1.0 - o.tangential / o.incident_tangential; };
  speed.closed = [=](double angle) -> std::optional<double> {
    if (!slides(angle)) return {};
    return 1.0 - mu * (1.0 + e) / std::tan(radians(angle));
  };
  ObliqueTest spin = speed;
  spin.file = "test_4_spin";
  spin.quantity = "spin";
  spin.y_label = "spin after the impact [rad/s]";
  spin.y = spin.change = [](const Oblique& o) { return -o.spin; };
  spin.closed = [=](double angle) -> std::optional<double> {
    if (!slides(angle)) return {};
    return 2.5 * mu * (1.0 + e) * v * std::cos(radians(angle)) / R;
  };
  return {speed, spin};
}

/// Test 5: a tiny sphere on a wall, normal speed kept, tangential speed varied; v_s′/(μ v_n′) over x = v_s/(μ
/// v_n).
ObliqueTest tiny_sphere() {
  const double mu = 0.3, vn = 5.0;
  ObliqueTest test;
  test.name = "5: tiny sphere on a wall, steel";
  test.file = "test_5";
  test.quantity = "surface speed";
  test.x_label = "incident surface speed v_s / (μ v_n) [-]";
  test.y_label = "surface speed after v_s' / (μ v_n') [-]";
  test.points = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5,  5.0,  5.5,
                 6.0, 6.5, 7.0, 7.2, 7.5, 8.0, 8.5, 9.0, 10.0, 12.0, 14.0};
  test.impact = [=](double x) {
    Impact impact;
    impact.body = sphere_clump(1e-5);
    impact.material = elastic_material(208e9, 0.30, 7850.0);
    impact.contact = {1.0, mu, 0.0};
    impact.velocity = {vn, x * mu * vn, 0.0};
    return impact;
  };
  test.y = [=](const Oblique& o) { return o.slip / (mu * -o.closing); };
  test.change = [=](const Oblique& o) { return slip_change(o) / (mu * -o.closing); };
  test.closed = [](double x) { return x > 7.0 ? std::optional(x - 7.0) : std::nullopt; };
  return test;
}

struct Named {
  const char* name;
  const char* file;
  Material material;
};

/// Tests 6 and 8: a spinning sphere on a wall, or on a sphere of five times the radius and 1000 times the
/// density. β = −v_s′/v_s over x = 3.5 μ (1+e) v_n/v_s; β = x − 1 while it slides. A force that attracts at
/// the end carries friction too: the closed form holds for the clamped law alone.
ObliqueTest spinning(bool on_sphere, const Named& named, NormalDamping damping) {
  const double mu = 0.4, e = 0.5, vn = 0.2, R = 0.1;
  const bool clamped = damping == NormalDamping::clamped;
  ObliqueTest test;
  test.name =
      std::string(on_sphere ? "8: spinning sphere on a heavy one, " : "6: spinning sphere on a wall, ") +
      named.name + (clamped ? ", clamped" : ", with tail");
  test.file = std::string(on_sphere ? "test_8_" : "test_6_") + named.file + (clamped ? "_clamped" : "_tail");
  test.quantity = "surface restitution";
  test.x_label = "3.5 μ (1+e) v_n / v_s [-]";
  test.y_label = "surface restitution β = -v_s' / v_s [-]";
  test.points = {0.1, 0.2, 0.3,  0.4, 0.5,  0.6, 0.7, 0.8, 0.9, 0.95, 1.0,
                 1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0,  5.0};
  test.impact = [=](double x) {
    Impact impact;
    impact.body = sphere_clump(R);
    impact.material = named.material;
    impact.contact = {e, mu, 0.0};
    impact.damping = damping;
    impact.velocity = {vn, 0.0, 0.0};
    impact.spin = {0.0, 0.0, 3.5 * mu * (1.0 + e) * vn / x / R};
    if (on_sphere) {
      Clump heavy = sphere_clump(0.5);
      heavy.volume *= 1000.0;
      heavy.inertia *= 1000.0;
      impact.other = heavy;
    }
    return impact;
  };
  test.y = [](const Oblique& o) { return -o.slip / o.incident_slip; };
  test.change = [](const Oblique& o) { return slip_change(o) / o.incident_slip; };
  test.closed = [=](double x) { return clamped && x < 1.0 ? std::optional(x - 1.0) : std::nullopt; };
  return test;
}

}  // namespace

Oblique engine_outcome(const Impact& impact) {
  const Impact::Result result = impact.run();
  Oblique after = incidence(impact);
  after.tangential = result.velocity.y() - result.other_velocity.y();
  after.slip = slip_of(impact, result.velocity, result.spin, result.other_velocity, result.other_spin);
  after.spin = result.spin.z();
  after.closing = result.velocity.x() - result.other_velocity.x();
  return after;
}

Oblique quadrature_outcome(const Impact& impact) {
  Oblique after = incidence(impact);
  const reference::PlanarImpact planar = planar_impact(impact);
  const auto result = planar.run(impact.velocity.x() - impact.other_velocity.x(), after.incident_slip);
  after.tangential = after.incident_tangential + result.impulse * planar.mobility;
  after.slip = result.slip;
  after.spin = impact.spin.z() + result.torque_i * planar.turning_i;
  after.closing = result.closing;
  return after;
}

std::vector<ObliqueTest> oblique_tests() {
  std::vector<ObliqueTest> tests = angles_on_wall();
  tests.push_back(tiny_sphere());
  for (const bool on_sphere : {false, true})
    for (const Named& named : {Named{"aluminium alloy", "aluminium", elastic_material(70e9, 0.33, 2700.0)},
                               Named{"nylon", "nylon", elastic_material(2.5e9, 0.40, 1000.0)}})
      for (const auto damping : {NormalDamping::clamped, NormalDamping::with_tail})
        tests.push_back(spinning(on_sphere, named, damping));
  return tests;
}

}  // namespace repose::verification
