#include "engine/contact/law_parameters.hpp"
#include "reference/planar_impact.hpp"
#include "verification/table/impact.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr const char* kObliqueSource = "Chung & Ooi 2011";
constexpr const char* kQuadrature = "quadrature of the contact law";
constexpr double kObliqueBar = 5e-3;

/// The same impact by the plain planar quadrature. `slip` is the relative surface velocity along +y.
reference::PlanarImpact quadrature_of(const Impact& impact) {
  const auto elastic = [](const Material& m) { return ElasticSide{m.shear_modulus, m.poisson_ratio}; };
  const Material& other = impact.other ? impact.material : impact.wall;
  const double e = impact.contact.restitution;
  const bool clamped = impact.damping == NormalDamping::clamped;
  reference::PlanarImpact planar;
  planar.normal = {impact.Y_eff(), impact.R_eff(), impact.m_eff(),
                   clamped ? 2.0 * clamped_damping_ratio(e) : 2.0 * std::sqrt(5.0 / 6.0) * damping_ratio(e),
                   clamped};
  planar.G_eff = 1.0 / ((2.0 - impact.material.poisson_ratio) / elastic(impact.material).shear_modulus +
                        (2.0 - other.poisson_ratio) / elastic(other).shear_modulus);
  planar.gamma_t = 2.0 * std::sqrt(5.0 / 6.0) * damping_ratio(e);
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

/// Test 4: a sphere on a rigid wall, 3.9 m/s at 5–85° from the normal.
Rows angles_on_wall() {
  const double mu = 0.092, e = 0.98, v = 3.9, R = 2.5e-3;
  Worst closed("4: oblique on a wall, sliding: tangential restitution and spin, 35–85°", kObliqueSource,
               kObliqueBar);
  Worst curve("4: oblique on a wall, 5–85°: tangential speed and spin", kQuadrature, kObliqueBar);
  for (const double angle : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 45.0, 60.0, 75.0, 85.0}) {
    const double vn = v * std::cos(radians(angle)), vt = v * std::sin(radians(angle));
    Impact impact;
    impact.body = sphere_clump(R);
    impact.material = elastic_material(380e9, 0.23, 4000.0);
    impact.contact = {e, mu, 0.0};
    impact.velocity = {vn, vt, 0.0};
    const Impact::Result result = impact.run();
    const double spin = std::abs(result.spin.z());
    if (std::tan(radians(angle)) > 3.5 * mu * (1.0 + e)) {
      closed.add(1.0 - mu * (1.0 + e) / std::tan(radians(angle)), result.velocity.y() / vt);
      closed.add(2.5 * mu * (1.0 + e) * vn / R, spin);
    }
    const reference::PlanarImpact planar = quadrature_of(impact);
    const auto expected = planar.run(vn, vt);
    curve.add(vt + expected.impulse * planar.mobility, result.velocity.y(), vt);
    curve.add(std::abs(expected.torque_i) * planar.turning_i, spin, vt / R);
  }
  return {closed.row(), curve.row()};
}

/// Test 5: a tiny sphere on a wall, normal speed kept, tangential speed varied; vt′/(μ vn′) over x = vt/(μ
/// vn).
Rows tiny_sphere() {
  const double mu = 0.3, vn = 5.0, R = 1e-5;
  Worst closed("5: tiny sphere, sliding: surface speed over the incident, x 7.5 … 14", kObliqueSource,
               kObliqueBar);
  Worst curve("5: tiny sphere, x 0.5 … 14: surface speed over the incident", kQuadrature, kObliqueBar);
  for (const double x : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 7.5, 8.0, 9.0, 11.0, 14.0}) {
    Impact impact;
    impact.body = sphere_clump(R);
    impact.material = elastic_material(208e9, 0.30, 7850.0);
    impact.contact = {1.0, mu, 0.0};
    impact.velocity = {vn, x * mu * vn, 0.0};
    const Impact::Result result = impact.run();
    const double scale = mu * std::abs(result.velocity.x());
    const double after = (result.velocity.y() + result.spin.z() * R) / scale;
    if (x > 7.0) closed.add(x - 7.0, after, x);
    curve.add(quadrature_of(impact).run(vn, x * mu * vn).slip / scale, after, x);
  }
  return {closed.row(), curve.row()};
}

struct Named {
  const char* name;
  Material material;
};
const Named kAluminium{"aluminium alloy", elastic_material(70e9, 0.33, 2700.0)};
const Named kNylon{"nylon", elastic_material(2.5e9, 0.40, 1000.0)};

/// Tests 6 and 8: a spinning sphere on a wall, or on a sphere of five times the radius and 1000 times the
/// density. β = −v_s′/v_s over x = 3.5 μ (1+e) v_n/v_s; β = x − 1 while it slides.
Rows spinning(bool on_sphere) {
  const double mu = 0.4, e = 0.5, vn = 0.2, R = 0.1;
  const std::string number =
      on_sphere ? "8: spinning sphere on a heavy one, " : "6: spinning sphere on a wall, ";
  Rows rows;
  for (const Named& named : {kAluminium, kNylon})
    for (const auto damping : {NormalDamping::clamped, NormalDamping::with_tail}) {
      // A force that attracts at the end carries friction too: the closed form holds for the clamped law
      // alone.
      const bool clamped = damping == NormalDamping::clamped;
      const std::string name = number + named.name + (clamped ? ", clamped" : ", with tail");
      Worst closed(name + ", sliding: surface restitution", kObliqueSource, kObliqueBar);
      Worst curve(name + ", x 0.2 … 5: surface restitution", kQuadrature, kObliqueBar);
      for (const double x : {0.2, 0.4, 0.6, 0.8, 0.95, 1.0, 1.2, 1.5, 2.0, 3.0, 5.0}) {
        const double vs = 3.5 * mu * (1.0 + e) * vn / x;
        Impact impact;
        impact.body = sphere_clump(R);
        impact.material = named.material;
        impact.contact = {e, mu, 0.0};
        impact.damping = damping;
        impact.velocity = {vn, 0.0, 0.0};
        impact.spin = {0.0, 0.0, vs / R};
        if (on_sphere) {
          Clump heavy = sphere_clump(0.5);
          heavy.volume *= 1000.0;
          heavy.inertia *= 1000.0;
          impact.other = heavy;
        }
        const Impact::Result result = impact.run();
        double after = result.velocity.y() + result.spin.z() * R;
        if (on_sphere) after -= result.other_velocity.y() - result.other_spin.z() * 0.5;
        if (clamped && x < 1.0) closed.add(x - 1.0, -after / vs, 1.0);
        curve.add(-quadrature_of(impact).run(vn, vs).slip / vs, -after / vs, 1.0);
      }
      if (clamped) rows.push_back(closed.row());
      rows.push_back(curve.row());
    }
  return rows;
}

/// Test 7: two equal spheres with equal and opposite spins: their surfaces do not move against each other.
Rows equal_spins() {
  Rows rows;
  for (const Named& named : {kAluminium, Named{"copper", elastic_material(120e9, 0.35, 8900.0)}}) {
    Worst worst(
        std::string("7: equal and opposite spins, ") + named.name + ": spins kept, no tangential speed",
        kObliqueSource, kObliqueBar);
    for (const double spin : {0.175, 1.0, 5.0, 10.0, 22.86}) {
      Impact impact;
      impact.body = sphere_clump(0.1);
      impact.material = named.material;
      impact.other = impact.body;
      impact.contact = {0.5, 0.4, 0.0};
      impact.velocity = {0.2, 0.0, 0.0};
      impact.other_velocity = {-0.2, 0.0, 0.0};
      impact.spin = {0.0, 0.0, spin};
      impact.other_spin = {0.0, 0.0, -spin};
      const Impact::Result result = impact.run();
      worst.add(spin, result.spin.z());
      worst.add(-spin, result.other_spin.z());
      worst.add(0.0, result.velocity.y(), 0.2);
    }
    rows.push_back(worst.row());
  }
  return rows;
}

}  // namespace

Rows oblique_impact_rows() {
  Rows rows = angles_on_wall();
  for (const Rows& more : {tiny_sphere(), spinning(false), equal_spins(), spinning(true)})
    rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace repose::verification
