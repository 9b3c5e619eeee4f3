#pragma once

#include <bit>

#include "engine/dynamics/contact_block.hpp"
#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// First pass: which near candidates touch.
inline void find_touching(ContactList& list, TouchingList& touching) {
  NearList& near = list.near_pairs;
  const double* record = list.placed.data()->centre;
  touching.start(near.count);
  for (std::size_t block = 0; block < near.blocks(); ++block) {
    unsigned mask = 0;
    for (std::size_t part = 0; part < NearList::kBlock; part += kSimdWidth) {
      const std::size_t first = block * NearList::kBlock + part;
      const Fields4 a = load_fields4(record, near.sphere_a.data() + first),
                    b = load_fields4(record, near.sphere_b.data() + first);
      const SimdReal dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2], reach = a[3] + b[3];
      mask |= less_bits(dx * dx + dy * dy + dz * dz, reach * reach) << part;
    }
    mark_touching(list.pairs, near, block, mask);
    touching.take(near, block, mask);
  }
  touching.finish();
}

/// RollingContact::inertia_or_limit of a pair under type_c: I_r = 1/Σ 1/(I + m |arm|²).
REPOSE_INLINE SimdReal inertia_about_contact(const BlockSide& i, const BlockSide& j,
                                             const Triple<SimdReal>& arm_i, const Triple<SimdReal>& arm_j) {
  const SimdReal about_i = i.inertia_term + i.mass * dot(arm_i, arm_i);
  const SimdReal about_j = j.inertia_term + j.mass * dot(arm_j, arm_j);
  return about_i * about_j / (about_i + about_j);
}

/// n, R*, m*, 1/m* and, under type_a_relative, 1/(Δt Σ n/I_min): the torque per spin of which all contacts of
/// a body together at most stop it within a step. Their five divisions are one, by the product of all
/// denominators: the others are products of what is left of it.
template <RollingModel kModel>
REPOSE_INLINE ContactGeometry<SimdReal> pair_geometry(const BlockSide& i, const BlockSide& j, double dt) {
  const Triple<SimdReal> d = i.centre - j.centre;
  const SimdReal distance = length(d), reach = i.radius + j.radius;
  const SimdReal mass = i.mass + j.mass, masses = i.mass * j.mass;
  ContactGeometry<SimdReal> contact;
  contact.overlap = reach - distance;
  contact.inertia_or_limit = 0.0;
  const SimdReal lengths = distance * reach, inertia = mass * masses;
  SimdReal inverse;
  if constexpr (kModel == RollingModel::type_a_relative) {
    const SimdReal softness = dt * (i.inertia_term + j.inertia_term);
    const SimdReal of_all = 1.0 / (lengths * inertia * softness);
    contact.inertia_or_limit = of_all * (lengths * inertia);
    inverse = of_all * softness;
  } else {
    inverse = 1.0 / (lengths * inertia);
  }
  const SimdReal of_lengths = inverse * inertia, of_masses = inverse * lengths;
  contact.n = SimdReal(of_lengths * reach) * d;
  contact.R_eff = i.radius * j.radius * (of_lengths * distance);
  contact.m_eff = masses * masses * of_masses;
  contact.inverse_m_eff = mass * mass * of_masses;
  return contact;
}

/// Second pass: the contact law for one block of touching pairs. The contact point lies in the middle of the
/// overlap.
template <RollingModel kModel>
REPOSE_INLINE void pair_block(const ForceStep& step, Bodies& bodies, ContactList& list,
                              const TouchingList& touching, std::size_t first, PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  const std::size_t lanes = std::min(kSimdWidth, touching.count - first);
  const std::int32_t *body_i = touching.body_a.data() + first, *body_j = touching.body_b.data() + first;
  const BlockSide i = load_side(bodies, list.placed, touching.sphere_a.data() + first, body_i);
  const BlockSide j = load_side(bodies, list.placed, touching.sphere_b.data() + first, body_j);

  ContactGeometry<SimdReal> contact = pair_geometry<kModel>(i, j, step.dt);
  const Triple<SimdReal> arm_i = i.arm - (i.radius - 0.5 * contact.overlap) * contact.n;
  const Triple<SimdReal> arm_j = j.arm + (j.radius - 0.5 * contact.overlap) * contact.n;
  if constexpr (kModel == RollingModel::type_c)
    contact.inertia_or_limit = inertia_about_contact(i, j, arm_i, arm_j);

  Triple<SimdReal> lead;
  ContactTiming<SimdReal> timing{step.dt, step.lag, step.booked, nullptr};
  if (step.leads) {
    lead = lead_of(bodies, body_i, arm_i) - lead_of(bodies, body_j, arm_j);
    timing.lead = &lead;
  }
  const std::int32_t* at_history = touching.history.data() + first;
  ContactHistory<SimdReal> history = load_history(list.pairs, at_history, kSpring);
  const ContactForces<SimdReal> f = contact_forces<kModel>(step.pair_law, contact, {i.velocity, i.w, arm_i},
                                                           {j.velocity, j.w, arm_j}, timing, history);
  store_history(history, list.pairs, at_history, lanes, kSpring);
  if (step.booked) sum.add(f.power, SimdReal(0.0), lanes);

  SimdReal resist_i = 0.0, resist_j = 0.0;
  if constexpr (kModel == RollingModel::type_a) {
    const SimdReal size = step.pair_law.rolling * absolute(f.F_n);
    resist_i = size * length(arm_i);
    resist_j = size * length(arm_j);
  }
  const Triple<SimdReal> minus = SimdReal(-1.0) * f.force;
  add_fields8(load_fields(f.force, resist_i, cross(arm_i, f.force) + f.rolling_torque), body_i,
              load_fields(minus, resist_j, cross(arm_j, minus) - f.rolling_torque), body_j,
              bodies.load.data()->force, lanes);
}

template <RollingModel kModel>
ContactWork pair_forces(const ForceStep& step, Bodies& bodies, ContactList& list, TouchingList& touching) {
  find_touching(list, touching);
  PowerSum sum;
  for (std::size_t first = 0; first < touching.count; first += kSimdWidth)
    pair_block<kModel>(step, bodies, list, touching, first, sum);
  return sum.work(step.dt);
}

}  // namespace repose
