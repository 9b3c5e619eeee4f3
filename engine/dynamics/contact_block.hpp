#pragma once

#include <algorithm>
#include <bit>

#include "engine/contact/contact_law.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// A block of kSimdWidth contacts between the arrays in memory and the contact law.
static_assert(sizeof(BodyMotion) == 64 && sizeof(BodyLoad) == 64 && sizeof(BodyLead) == 64 &&
              sizeof(BodyAxes) == 128);
static_assert(sizeof(PlacedSphere) == 32 && sizeof(SpringRecord) == 32 && sizeof(RollingRecord) == 32);

/// One side of a block: spheres with their bodies.
struct BlockSide {
  Triple<SimdReal> centre, arm, velocity, w;
  SimdReal radius, mass, inertia_term;
};

/// Where the centres of mass are, from what their spheres were placed by; those of single spheres are not
/// kept there (BodyAxes), and have no arms.
REPOSE_INLINE Triple<SimdReal> arm_of(const Bodies& bodies, const std::int32_t* body,
                                      const Triple<SimdReal>& centre) {
  if (!bodies.oriented) return {SimdReal(0.0), SimdReal(0.0), SimdReal(0.0)};
  LaneOffsets at;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) at[lane] = 2 * body[lane];
  const Fields4 position = load_fields4(bodies.axes.data()->position, at.data());
  return centre - Triple<SimdReal>{position[0], position[1], position[2]};
}

/// @param sphere, body  offsets of the records, TouchingList
REPOSE_INLINE BlockSide load_side(const Bodies& bodies, std::span<const PlacedSphere> placed,
                                  const std::int32_t* sphere, const std::int32_t* body) {
  BlockSide side;
  const Fields4 s = load_fields4(placed.data()->centre, sphere);
  const Fields8 m = load_fields8(bodies.motion.data()->velocity, body);
  side.centre = {s[0], s[1], s[2]};
  side.radius = s[3];
  side.arm = arm_of(bodies, body, side.centre);
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
REPOSE_INLINE ContactHistory<SimdReal> load_history(const NearList& contacts, const std::int32_t* history,
                                                    bool rolling) {
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

REPOSE_INLINE void store_history(const ContactHistory<SimdReal>& loaded, NearList& contacts,
                                 const std::int32_t* history, std::size_t lanes, bool rolling) {
  const TangentialSpring<SimdReal>& spring = loaded.tangential;
  store_fields4({spring.value.x, spring.value.y, spring.value.z, spring.root}, contacts.spring.data()->value,
                history, lanes);
  if (!rolling) return;
  const Triple<SimdReal>& torque = loaded.rolling;
  store_fields4({torque.x, torque.y, torque.z, SimdReal(0.0)}, contacts.rolling.data()->torque, history,
                lanes);
}

// Two blocks side by side, and what comes out of them.
REPOSE_INLINE ContactHistory<Twin> twin(const ContactHistory<SimdReal>& a,
                                        const ContactHistory<SimdReal>& b) {
  return {{twin(a.tangential.value, b.tangential.value), {a.tangential.root, b.tangential.root}},
          twin(a.rolling, b.rolling)};
}
REPOSE_INLINE ContactGeometry<Twin> twin(const ContactGeometry<SimdReal>& a,
                                         const ContactGeometry<SimdReal>& b) {
  return {twin(a.n, b.n),
          {a.overlap, b.overlap},
          {a.R_eff, b.R_eff},
          {a.m_eff, b.m_eff},
          {a.inertia_or_limit, b.inertia_or_limit},
          {a.inverse_m_eff, b.inverse_m_eff}};
}
REPOSE_INLINE ContactMotion<Twin> twin(const ContactMotion<SimdReal>& a, const ContactMotion<SimdReal>& b) {
  return {twin(a.v, b.v), twin(a.w_rel, b.w_rel), {a.w_normal, b.w_normal}};
}
template <int kHalf>
REPOSE_INLINE ContactHistory<SimdReal> half_of(const ContactHistory<Twin>& h) {
  return {{half_of<kHalf>(h.tangential.value), h.tangential.root.half<kHalf>()}, half_of<kHalf>(h.rolling)};
}
template <int kHalf>
REPOSE_INLINE ContactForces<SimdReal> half_of(const ContactForces<Twin>& f) {
  const ContactPower<Twin>& p = f.power;
  return {half_of<kHalf>(f.force),
          half_of<kHalf>(f.rolling_torque),
          f.F_n.half<kHalf>(),
          {p.normal_damping.half<kHalf>(), p.tangential_damping.half<kHalf>(), p.spring.half<kHalf>(),
           p.rolling.half<kHalf>()}};
}

/// Sums the power of blocks, lane by lane.
struct PowerSum {
  SimdReal normal_damping = 0.0, tangential_damping = 0.0, spring = 0.0, rolling = 0.0, wall = 0.0;

  REPOSE_INLINE void add(const ContactPower<SimdReal>& power, std::size_t lanes) {
    normal_damping += real(power.normal_damping, lanes);
    tangential_damping += real(power.tangential_damping, lanes);
    spring += real(power.spring, lanes);
    rolling += real(power.rolling, lanes);
  }
  REPOSE_INLINE void add_wall(const SimdReal& power, std::size_t lanes) { wall += real(power, lanes); }
  /// Lanes beyond `lanes` repeat a contact and count for nothing.
  REPOSE_INLINE static SimdReal real(const SimdReal& power, std::size_t lanes) {
    if (lanes == kSimdWidth) return power;
    SimdReal counted = power;
    for (std::size_t lane = lanes; lane < kSimdWidth; ++lane) counted[lane] = 0.0;
    return counted;
  }
  [[nodiscard]] ContactWork work(double dt) const {
    return {dt * stdx::reduce(normal_damping), dt * stdx::reduce(tangential_damping),
            dt * stdx::reduce(spring), dt * stdx::reduce(rolling), dt * stdx::reduce(wall)};
  }
};

/// Brings a block of near candidates to this step.
inline void mark_touching(NearList& near, std::size_t block, unsigned touching) {
  const unsigned before = near.touching[block];
  near.touching[block] = static_cast<std::uint8_t>(touching);
  for (unsigned met = touching & ~before; met != 0; met &= met - 1)
    near.begin(block * NearList::kBlock + static_cast<std::size_t>(std::countr_zero(met)));
}

}  // namespace repose
