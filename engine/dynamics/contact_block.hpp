#pragma once

#include <algorithm>

#include "engine/contact/contact_law.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// A block of kSimdWidth contacts between the arrays in memory and the contact law.
static_assert(sizeof(BodyMotion) == 64 && sizeof(BodyLoad) == 64 && sizeof(BodyLead) == 64 &&
              sizeof(PlacedSphere) == 64);
static_assert(sizeof(SpringRecord) == 32 && sizeof(RollingRecord) == 32);

/// One side of a block: spheres with their bodies.
struct BlockSide {
  Triple<SimdReal> centre, arm, velocity, w;
  SimdReal radius, mass, inertia_term;
};

/// @param sphere, body  offsets of the records, TouchingList
REPOSE_INLINE BlockSide load_side(const Bodies& bodies, const std::vector<PlacedSphere>& placed,
                                  const std::int32_t* sphere, const std::int32_t* body) {
  BlockSide side;
  const Fields8 s = load_fields8(placed.data()->centre, sphere);
  const Fields8 m = load_fields8(bodies.motion.data()->velocity, body);
  side.centre = {s[0], s[1], s[2]};
  side.radius = s[3];
  side.arm = {s[4], s[5], s[6]};
  side.velocity = {m[0], m[1], m[2]};
  side.mass = m[3];
  side.w = {m[4], m[5], m[6]};
  side.inertia_term = m[7];
  return side;
}

/// What Bodies::lead adds to the velocity at the contact point of one side.
REPOSE_INLINE Triple<SimdReal> lead_of(const Bodies& bodies, const std::int32_t* body,
                                       const Triple<SimdReal>& arm) {
  const Fields8 lead = load_fields8(bodies.lead.data()->velocity, body);
  return Triple<SimdReal>{lead[0], lead[1], lead[2]} +
         cross(Triple<SimdReal>{lead[4], lead[5], lead[6]}, arm);
}

/// What force and torque on a body add to its record (BodyLoad).
REPOSE_INLINE Fields8 load_fields(const Triple<SimdReal>& force, const SimdReal& rolling,
                                  const Triple<SimdReal>& torque) {
  return {force.x, force.y, force.z, rolling, torque.x, torque.y, torque.z, SimdReal(1.0)};
}

/// @param history  offsets of the records, TouchingList
REPOSE_INLINE ContactHistory<SimdReal> load_history(const CandidateArrays& contacts,
                                                    const std::int32_t* history, bool rolling) {
  const Fields4 spring = load_fields4(contacts.spring.data()->value, history);
  ContactHistory<SimdReal> loaded;
  loaded.tangential = {{spring[0], spring[1], spring[2]}, spring[3]};
  loaded.rolling = {SimdReal(0.0), SimdReal(0.0), SimdReal(0.0)};
  if (rolling) {
    const Fields4 torque = load_fields4(contacts.rolling.data()->torque, history);
    loaded.rolling = {torque[0], torque[1], torque[2]};
  }
  return loaded;
}

REPOSE_INLINE void store_history(const ContactHistory<SimdReal>& loaded, CandidateArrays& contacts,
                                 const std::int32_t* history, std::size_t lanes, bool rolling) {
  const TangentialSpring<SimdReal>& spring = loaded.tangential;
  store_fields4({spring.value.x, spring.value.y, spring.value.z, spring.root}, contacts.spring.data()->value,
                history, lanes);
  if (!rolling) return;
  const Triple<SimdReal>& torque = loaded.rolling;
  store_fields4({torque.x, torque.y, torque.z, SimdReal(0.0)}, contacts.rolling.data()->torque, history,
                lanes);
}

/// Sums the power of blocks, lane by lane.
struct PowerSum {
  SimdReal normal_damping = 0.0, tangential_damping = 0.0, spring = 0.0, rolling = 0.0, wall = 0.0;

  REPOSE_INLINE void add(const ContactPower<SimdReal>& power, const SimdReal& of_wall, std::size_t lanes) {
    SimdReal real = 1.0;
    if (lanes < kSimdWidth)  // the others repeat a contact
      for (std::size_t lane = lanes; lane < kSimdWidth; ++lane) real[lane] = 0.0;
    normal_damping += real * power.normal_damping;
    tangential_damping += real * power.tangential_damping;
    spring += real * power.spring;
    rolling += real * power.rolling;
    wall += real * of_wall;
  }
  [[nodiscard]] ContactWork work(double dt) const {
    return {dt * stdx::reduce(normal_damping), dt * stdx::reduce(tangential_damping),
            dt * stdx::reduce(spring), dt * stdx::reduce(rolling), dt * stdx::reduce(wall)};
  }
};

/// Brings a block of near candidates to this step; candidates that no longer touch forget.
inline void mark_touching(CandidateArrays& contacts, NearList& near, std::size_t block, unsigned touching) {
  const unsigned before = near.touching[block];
  if (before == touching) return;
  near.touching[block] = static_cast<std::uint8_t>(touching);
  for (unsigned changed = before ^ touching; changed != 0; changed &= changed - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(changed));
    const auto c = near.candidate(block * NearList::kBlock + k);
    if ((touching >> k) & 1U)
      contacts.touching.set(c, true);
    else
      contacts.forget(c);
  }
}

}  // namespace repose
