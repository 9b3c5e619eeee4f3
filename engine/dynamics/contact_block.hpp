#pragma once

#include <algorithm>

#include "engine/contact/contact_law.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// A block of kSimdWidth contacts between the arrays in memory and the contact law.
inline constexpr std::int32_t kLine = 8;  ///< doubles of a record that fills a cache line
static_assert(sizeof(BodyMotion) == 64 && sizeof(BodyLoad) == 64 && sizeof(BodyLead) == 64 &&
              sizeof(PlacedSphere) == 64);
static_assert(sizeof(SpringRecord) == 32 && sizeof(RollingRecord) == 32);

/// One side of a block: spheres with their bodies.
struct BlockSide {
  LaneOffsets body;  ///< offsets of the bodies' records
  Triple<SimdReal> centre, arm, velocity, w;
  SimdReal radius, mass, inertia_term;
};

REPOSE_INLINE BlockSide load_side(const Bodies& bodies, const std::vector<PlacedSphere>& placed,
                                  const LaneOffsets& index) {
  BlockSide side;
  LaneOffsets sphere;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    sphere[lane] = kLine * index[lane];
    side.body[lane] = kLine * placed[static_cast<std::size_t>(index[lane])].body;
  }
  const Fields8 s = load_fields8(placed.data()->centre, sphere);
  const Fields8 m = load_fields8(bodies.motion.data()->velocity, side.body);
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
REPOSE_INLINE Triple<SimdReal> lead_of(const Bodies& bodies, const LaneOffsets& body,
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

/// History of a block of contacts, read before the law and written after it.
struct BlockHistory {
  LaneOffsets offset;
  ContactHistory<SimdReal> history;
};

REPOSE_INLINE BlockHistory load_history(const CandidateArrays& contacts, const LaneOffsets& candidate,
                                        bool rolling) {
  BlockHistory block;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) block.offset[lane] = 4 * candidate[lane];
  const Fields4 spring = load_fields4(contacts.spring.data()->value, block.offset);
  block.history.tangential = {{spring[0], spring[1], spring[2]}, spring[3]};
  block.history.rolling = {SimdReal(0.0), SimdReal(0.0), SimdReal(0.0)};
  if (rolling) {
    const Fields4 torque = load_fields4(contacts.rolling.data()->torque, block.offset);
    block.history.rolling = {torque[0], torque[1], torque[2]};
  }
  return block;
}

REPOSE_INLINE void store_history(const BlockHistory& block, CandidateArrays& contacts, std::size_t lanes,
                                 bool rolling) {
  const TangentialSpring<SimdReal>& spring = block.history.tangential;
  store_fields4({spring.value.x, spring.value.y, spring.value.z, spring.root}, contacts.spring.data()->value,
                block.offset, lanes);
  if (!rolling) return;
  const Triple<SimdReal>& torque = block.history.rolling;
  store_fields4({torque.x, torque.y, torque.z, SimdReal(0.0)}, contacts.rolling.data()->torque, block.offset,
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

/// Entries `first` … of a list; lanes beyond its end repeat the last entry. Returns the number of lanes that
/// are real.
REPOSE_INLINE std::size_t take_lanes(const std::vector<std::int32_t>& list, std::size_t first,
                                     LaneOffsets& taken) {
  const std::size_t lanes = std::min(kSimdWidth, list.size() - first);
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) taken[lane] = list[first + std::min(lane, lanes - 1)];
  return lanes;
}

/// Candidates that touched at the last step and no longer do forget their history.
inline void forget_lost(CandidateArrays& contacts, std::size_t block, std::uint8_t touching) {
  const auto lost = static_cast<std::uint8_t>(contacts.was_touching[block] & ~touching);
  contacts.was_touching[block] = touching;
  if (lost == 0) return;
  for (std::size_t k = 0; k < CandidateArrays::kBlock; ++k) {
    if (!((lost >> k) & 1U)) continue;
    contacts.spring[block * CandidateArrays::kBlock + k] = {};
    contacts.rolling[block * CandidateArrays::kBlock + k] = {};
  }
}

}  // namespace repose
