#pragma once

#include <array>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/contact/contact_law.hpp"
#include "reference/plain_contact.hpp"

namespace repose::test {

template <class T>
Triple<T> triple(const Vec3& v) {
  return {T(v.x()), T(v.y()), T(v.z())};
}
inline Vec3 vec3(const Triple<double>& t) { return {t.x, t.y, t.z}; }

/// Laws over the whole range of inputs and every choice of law.
inline reference::ContactMaterial random_material(RandomStream& random, RollingModel model) {
  reference::ContactMaterial m;
  m.a = {std::pow(10.0, random.uniform(6.0, 11.0)), random.uniform(0.0, 0.5)};
  m.b = {std::pow(10.0, random.uniform(6.0, 11.0)), random.uniform(0.0, 0.5)};
  m.e = random.uniform(0.02, 0.9);
  m.friction = random.uniform(0.0, 1.5);
  m.rolling = random.uniform(0.0, 0.5);
  m.rolling_damping = random.uniform(0.0, 1.0);
  m.model = model;
  m.history = random.uniform() < 0.5 ? TangentialHistory::force : TangentialHistory::displacement;
  m.damping = random.uniform() < 0.5 ? NormalDamping::with_tail : NormalDamping::clamped;
  m.beta_clamped = clamped_damping_ratio(m.e);
  return m;
}

inline LawParameters law_of(const reference::ContactMaterial& m) {
  return law_parameters({m.a.shear_modulus, m.a.poisson_ratio}, {m.b.shear_modulus, m.b.poisson_ratio}, m.e,
                        m.friction, m.rolling, m.rolling_damping, m.damping, m.history);
}

/// One contact with its history, as both implementations take it.
struct RandomContact {
  reference::PlainContact contact;
  reference::PlainSide i, j;
  reference::PlainMemory memory;
};

inline Vec3 random_vector(RandomStream& random, double size) {
  return size * Vec3(random.normal(), random.normal(), random.normal());
}

inline RandomContact random_contact(RandomStream& random, const reference::ContactMaterial& material) {
  RandomContact c;
  const double R = std::pow(10.0, random.uniform(-4.0, -2.0));
  c.contact.n = random_vector(random, 1.0).normalized();
  c.contact.R_eff = R;
  c.contact.m_eff = 1e4 * R * R * R * random.uniform(0.2, 5.0);
  c.contact.overlap = R * std::pow(10.0, random.uniform(-6.0, -1.0));
  c.contact.rolling_inertia = c.contact.m_eff * R * R;
  c.contact.most_per_spin = std::pow(10.0, random.uniform(-3.0, 3.0)) * c.contact.m_eff * R * R;
  for (auto* side : {&c.i, &c.j}) {
    side->velocity = random_vector(random, std::pow(10.0, random.uniform(-4.0, 0.5)));
    side->w = random_vector(random, std::pow(10.0, random.uniform(-2.0, 2.0)));
    side->arm = random_vector(random, 2.0 * R);
  }
  // Springs of the size that friction allows, from fresh to at the limit; on loading as well as unloading.
  const double a = std::sqrt(R * c.contact.overlap);
  const double F = 4.0 / 3.0 * material.Y_eff() * a * c.contact.overlap;
  const Vec3 across = reference::tangent_part(random_vector(random, 1.0), c.contact.n).normalized();
  const double force = random.uniform() < 0.2 ? 0.0 : F * material.friction * random.uniform();
  c.memory.spring =
      across * (material.history == TangentialHistory::force ? force : force / (8.0 * material.G_eff() * a));
  c.memory.radius = force == 0.0 ? 0.0 : a * random.uniform(0.8, 1.2);
  if (material.model == RollingModel::type_c || material.model == RollingModel::type_c_undamped)
    c.memory.rolling = reference::tangent_part(random_vector(random, 1.0), c.contact.n).normalized() * F *
                       material.rolling * R * random.uniform();
  return c;
}

template <class T>
struct EngineContact {
  ContactGeometry<T> geometry;
  ContactSide<T> i, j;
  ContactHistory<T> history;
};

inline EngineContact<double> engine_contact(const RandomContact& c, RollingModel model) {
  EngineContact<double> result;
  result.geometry = {triple<double>(c.contact.n),
                     c.contact.overlap,
                     c.contact.R_eff,
                     c.contact.m_eff,
                     model == RollingModel::type_c ? c.contact.rolling_inertia : c.contact.most_per_spin,
                     1.0 / c.contact.m_eff};
  const auto side = [](const reference::PlainSide& s) {
    return ContactSide<double>{triple<double>(s.velocity), triple<double>(s.w), triple<double>(s.arm)};
  };
  result.i = side(c.i);
  result.j = side(c.j);
  result.history = {{triple<double>(c.memory.spring), c.memory.radius}, triple<double>(c.memory.rolling)};
  return result;
}

/// Every number of an EngineContact, in a fixed order.
template <class T, class Visit>
void visit_numbers(EngineContact<T>& c, Visit visit) {
  const auto three = [&visit](Triple<T>& t) { visit(t.x), visit(t.y), visit(t.z); };
  three(c.geometry.n);
  visit(c.geometry.overlap), visit(c.geometry.R_eff), visit(c.geometry.m_eff),
      visit(c.geometry.inertia_or_limit), visit(c.geometry.inverse_m_eff);
  for (auto* side : {&c.i, &c.j}) three(side->velocity), three(side->w), three(side->arm);
  three(c.history.tangential.value);
  visit(c.history.tangential.root);
  three(c.history.rolling);
}

using Block = std::array<EngineContact<double>, kSimdWidth>;

inline EngineContact<SimdReal> to_lanes(Block& block) {
  EngineContact<SimdReal> lanes;
  std::vector<std::array<double, kSimdWidth>> rows;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    std::size_t row = 0;
    visit_numbers(block[lane], [&](double& value) {
      if (row == rows.size()) rows.emplace_back();
      rows[row++][lane] = value;
    });
  }
  std::size_t row = 0;
  visit_numbers(lanes, [&](SimdReal& value) { value.copy_from(rows[row++].data(), stdx::element_aligned); });
  return lanes;
}

/// Force, torque, F_n and the history of one contact after one step.
using Numbers = std::array<double, 14>;

inline Numbers numbers_of(const reference::PlainForces& f, const reference::PlainMemory& m) {
  return {f.force.x(),  f.force.y(),   f.force.z(),   f.torque.x(), f.torque.y(),
          f.torque.z(), f.F_n,         m.spring.x(),  m.spring.y(), m.spring.z(),
          m.radius,     m.rolling.x(), m.rolling.y(), m.rolling.z()};
}
template <class T>
std::array<T, 14> numbers_of(const ContactForces<T>& f, const ContactHistory<T>& h, bool torque) {
  const T zero = 0.0;
  const Triple<T> t = torque ? f.rolling_torque : Triple<T>{zero, zero, zero};
  return {f.force.x,
          f.force.y,
          f.force.z,
          t.x,
          t.y,
          t.z,
          f.F_n,
          h.tangential.value.x,
          h.tangential.value.y,
          h.tangential.value.z,
          h.tangential.root,
          h.rolling.x,
          h.rolling.y,
          h.rolling.z};
}

}  // namespace repose::test
