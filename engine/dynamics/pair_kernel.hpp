#pragma once

#include <bit>

#include "engine/dynamics/contact_block.hpp"
#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// First pass: which candidates touch. Fills `touching` with their numbers, ascending.
inline void find_touching(ContactList& list, std::vector<std::int32_t>& touching) {
  touching.clear();
  CandidateArrays& pairs = list.pairs;
  const double* record = list.placed.data()->centre;
  for (std::size_t block = 0; block < pairs.blocks(); ++block) {
    unsigned mask = 0;
    for (std::size_t part = 0; part < CandidateArrays::kBlock; part += kSimdWidth) {
      const std::size_t first = block * CandidateArrays::kBlock + part;
      LaneOffsets at_a, at_b;
      for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
        at_a[lane] = kLine * pairs.a[first + lane];
        at_b[lane] = kLine * pairs.b[first + lane];
      }
      const Fields4 a = load_fields4(record, at_a), b = load_fields4(record, at_b);
      const SimdReal dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2], reach = a[3] + b[3];
      mask |= less_bits(dx * dx + dy * dy + dz * dz, reach * reach) << part;
    }
    forget_lost(pairs, block, static_cast<std::uint8_t>(mask));
    for (; mask != 0; mask &= mask - 1)
      touching.push_back(static_cast<std::int32_t>(block * CandidateArrays::kBlock) + std::countr_zero(mask));
  }
}

/// RollingContact::inertia_or_limit of a pair.
///   type_a_relative: 1/(Δt Σ n/I_min), so that all contacts of a body together at most stop it within a step
///   type_c: I_r = 1/Σ 1/(I + m |arm|²)
template <RollingModel kModel>
REPOSE_INLINE SimdReal inertia_or_limit(const BlockSide& i, const BlockSide& j, const Triple<SimdReal>& arm_i,
                                        const Triple<SimdReal>& arm_j, double dt) {
  if constexpr (kModel == RollingModel::type_a_relative)
    return 1.0 / (dt * (i.inertia_term + j.inertia_term));
  if constexpr (kModel == RollingModel::type_c) {
    const SimdReal about_i = i.inertia_term + i.mass * dot(arm_i, arm_i);
    const SimdReal about_j = j.inertia_term + j.mass * dot(arm_j, arm_j);
    return about_i * about_j / (about_i + about_j);
  }
  return SimdReal(0.0);
}

/// Second pass: the contact law for one block of touching pairs. The contact point lies in the middle of the
/// overlap.
template <RollingModel kModel>
REPOSE_INLINE void pair_block(const ForceStep& step, Bodies& bodies, ContactList& list,
                              const std::vector<std::int32_t>& touching, std::size_t first, PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  LaneOffsets candidate, index_a, index_b;
  const std::size_t lanes = take_lanes(touching, first, candidate);
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    index_a[lane] = list.pairs.a[static_cast<std::size_t>(candidate[lane])];
    index_b[lane] = list.pairs.b[static_cast<std::size_t>(candidate[lane])];
  }
  const BlockSide i = load_side(bodies, list.placed, index_a), j = load_side(bodies, list.placed, index_b);

  const Triple<SimdReal> d = i.centre - j.centre;
  const SimdReal distance = length(d);
  const SimdReal reach = i.radius + j.radius;
  ContactGeometry<SimdReal> contact;
  contact.n = SimdReal(1.0 / distance) * d;
  contact.overlap = reach - distance;
  contact.R_eff = i.radius * j.radius / reach;
  contact.m_eff = i.mass * j.mass / (i.mass + j.mass);
  const Triple<SimdReal> arm_i = i.arm - (i.radius - 0.5 * contact.overlap) * contact.n;
  const Triple<SimdReal> arm_j = j.arm + (j.radius - 0.5 * contact.overlap) * contact.n;
  contact.inertia_or_limit = inertia_or_limit<kModel>(i, j, arm_i, arm_j, step.dt);

  Triple<SimdReal> lead;
  ContactTiming<SimdReal> timing{step.dt, step.lag, step.booked, nullptr};
  if (step.leads) {
    lead = lead_of(bodies, i.body, arm_i) - lead_of(bodies, j.body, arm_j);
    timing.lead = &lead;
  }
  BlockHistory block = load_history(list.pairs, candidate, kSpring);
  const ContactForces<SimdReal> f = contact_forces<kModel>(step.pair_law, contact, {i.velocity, i.w, arm_i},
                                                           {j.velocity, j.w, arm_j}, timing, block.history);
  store_history(block, list.pairs, lanes, kSpring);
  if (step.booked) sum.add(f.power, SimdReal(0.0), lanes);

  SimdReal resist_i = 0.0, resist_j = 0.0;
  if constexpr (kModel == RollingModel::type_a) {
    const SimdReal size = step.pair_law.rolling * absolute(f.F_n);
    resist_i = size * length(arm_i);
    resist_j = size * length(arm_j);
  }
  const Triple<SimdReal> minus = SimdReal(-1.0) * f.force;
  add_fields8(load_fields(f.force, resist_i, cross(arm_i, f.force) + f.rolling_torque), i.body,
              load_fields(minus, resist_j, cross(arm_j, minus) - f.rolling_torque), j.body,
              bodies.load.data()->force, lanes);
}

template <RollingModel kModel>
ContactWork pair_forces(const ForceStep& step, Bodies& bodies, ContactList& list,
                        std::vector<std::int32_t>& touching) {
  find_touching(list, touching);
  PowerSum sum;
  for (std::size_t first = 0; first < touching.size(); first += kSimdWidth)
    pair_block<kModel>(step, bodies, list, touching, first, sum);
  return sum.work(step.dt);
}

}  // namespace repose
