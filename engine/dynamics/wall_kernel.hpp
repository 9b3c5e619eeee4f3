#pragma once

#include <algorithm>

#include "engine/dynamics/contact_block.hpp"
#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// First pass: the exact distance of every candidate to its wall. Wall shapes branch, so this pass is scalar;
/// wall candidates are a small part of all.
inline void find_touching_walls(ContactList& list, std::span<const Wall> walls, TouchingWalls& touching) {
  for (auto* array : {&touching.nx, &touching.ny, &touching.nz, &touching.overlap}) array->clear();
  touching.candidate.clear();
  CandidateArrays& contacts = list.wall_contacts;
  for (std::size_t block = 0; block < contacts.blocks(); ++block) {
    unsigned mask = 0;
    const std::size_t first = block * CandidateArrays::kBlock;
    const std::size_t last = std::min(first + CandidateArrays::kBlock, contacts.count);
    for (std::size_t c = first; c < last; ++c) {
      const PlacedSphere& sphere = list.placed[static_cast<std::size_t>(contacts.a[c])];
      const WallDistance wall =
          distance_to(walls[static_cast<std::size_t>(contacts.b[c])], Vec3(sphere.centre));
      const double overlap = sphere.radius - wall.distance;
      if (!(overlap > 0.0)) continue;
      mask |= 1U << (c - first);
      touching.candidate.push_back(static_cast<std::int32_t>(c));
      touching.nx.push_back(wall.normal.x());
      touching.ny.push_back(wall.normal.y());
      touching.nz.push_back(wall.normal.z());
      touching.overlap.push_back(overlap);
    }
    forget_lost(contacts, block, static_cast<std::uint8_t>(mask));
  }
  // Whole vectors can be read at the end of the arrays.
  for (auto* array : {&touching.nx, &touching.ny, &touching.nz, &touching.overlap})
    array->resize(array->size() + kSimdWidth, 1.0);
}

/// Second pass: the contact law against walls of infinite mass and radius, R* = r, m* = m.
template <RollingModel kModel>
REPOSE_INLINE void wall_block(const ForceStep& step, Bodies& bodies, ContactList& list,
                              std::span<const Wall> walls, const TouchingWalls& touching, std::size_t first,
                              PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  LaneOffsets candidate, index;
  std::array<const Wall*, kSimdWidth> wall;
  const std::size_t lanes = take_lanes(touching.candidate, first, candidate);
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    const auto c = static_cast<std::size_t>(candidate[lane]);
    index[lane] = list.wall_contacts.a[c];
    wall[lane] = &walls[static_cast<std::size_t>(list.wall_contacts.b[c])];
  }
  const BlockSide i = load_side(bodies, list.placed, index);
  ContactGeometry<SimdReal> contact;
  contact.n = {load(touching.nx, first), load(touching.ny, first), load(touching.nz, first)};
  contact.overlap = load(touching.overlap, first);
  contact.R_eff = i.radius;
  contact.m_eff = i.mass;
  contact.inertia_or_limit = 0.0;
  const Triple<SimdReal> arm = i.arm - (i.radius - 0.5 * contact.overlap) * contact.n;
  if constexpr (kModel == RollingModel::type_a_relative)
    contact.inertia_or_limit = 1.0 / (step.dt * i.inertia_term);
  if constexpr (kModel == RollingModel::type_c)
    contact.inertia_or_limit = i.inertia_term + i.mass * dot(arm, arm);
  const Triple<SimdReal> none{SimdReal(0.0), SimdReal(0.0), SimdReal(0.0)};
  const Triple<SimdReal> v_wall{SimdReal([&](auto lane) { return wall[lane]->velocity.x(); }),
                                SimdReal([&](auto lane) { return wall[lane]->velocity.y(); }),
                                SimdReal([&](auto lane) { return wall[lane]->velocity.z(); })};

  Triple<SimdReal> lead;
  ContactTiming<SimdReal> timing{step.dt, step.lag, step.booked, nullptr};
  if (step.leads) {
    lead = lead_of(bodies, i.body, arm);
    timing.lead = &lead;
  }
  BlockHistory block = load_history(list.wall_contacts, candidate, kSpring);
  const ContactForces<SimdReal> f = contact_forces<kModel>(step.wall_law, contact, {i.velocity, i.w, arm},
                                                           {v_wall, none, none}, timing, block.history);
  store_history(block, list.wall_contacts, lanes, kSpring);
  if (step.booked) sum.add(f.power, dot(f.force, v_wall), lanes);
  SimdReal resist = 0.0;
  if constexpr (kModel == RollingModel::type_a)
    resist = step.wall_law.rolling * absolute(f.F_n) * length(arm);
  add_fields8(load_fields(f.force, resist, cross(arm, f.force) + f.rolling_torque), i.body,
              bodies.load.data()->force, lanes);
}

template <RollingModel kModel>
ContactWork wall_forces(const ForceStep& step, Bodies& bodies, ContactList& list, std::span<const Wall> walls,
                        TouchingWalls& touching) {
  find_touching_walls(list, walls, touching);
  PowerSum sum;
  for (std::size_t first = 0; first < touching.candidate.size(); first += kSimdWidth)
    wall_block<kModel>(step, bodies, list, walls, touching, first, sum);
  return sum.work(step.dt);
}

}  // namespace repose
