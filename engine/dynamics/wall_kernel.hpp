#pragma once

#include <algorithm>

#include "engine/dynamics/contact_block.hpp"
#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// The nearest point of a wall, if it can touch: most near candidates of a cylinder are turned down without a
/// root, and those of the base's top need none.
REPOSE_INLINE bool may_touch(const Wall& wall, const PlacedSphere& sphere, WallDistance& nearest) {
  const double x = sphere.centre[0], y = sphere.centre[1], z = sphere.centre[2];
  if (wall.kind == Wall::Kind::base && z >= 0.0 && x * x + y * y <= wall.radius * wall.radius) {
    nearest = {Vec3::UnitZ(), z};
    return true;
  }
  if (wall.kind == Wall::Kind::closed_shell) {
    const double from_axis = wall.radius - sphere.radius, dx = x - wall.x_offset;
    if (from_axis > 0.0 && dx * dx + y * y < from_axis * from_axis) return false;
  }
  nearest = distance_to(wall, Vec3(sphere.centre));
  return true;
}

/// First pass: the exact distance of every near candidate to its wall. Wall shapes branch, so this pass is
/// scalar; wall candidates are a small part of all.
inline void find_touching_walls(ForceKernels::Placed placed, NearList& near, std::span<const Wall> walls,
                                TouchingWalls& touching) {
  touching.start(near.count);
  for (auto* array : {&touching.nx, &touching.ny, &touching.nz, &touching.overlap})
    if (array->size() < touching.history.size()) array->resize(touching.history.size(), 1.0);
  for (std::size_t block = 0; block < near.blocks(); ++block) {
    unsigned mask = 0;
    const std::size_t first = block * NearList::kBlock;
    const std::size_t last = std::min(first + NearList::kBlock, near.count);
    std::size_t n = touching.count;
    for (std::size_t k = first; k < last; ++k) {
      const PlacedSphere& sphere = near.first(placed, k);
      WallDistance wall;
      if (!may_touch(walls[near.wall(k)], sphere, wall)) continue;
      const double overlap = sphere.radius - wall.distance;
      if (!(overlap > 0.0)) continue;
      mask |= 1U << (k - first);
      touching.nx[n] = wall.normal.x(), touching.ny[n] = wall.normal.y(), touching.nz[n] = wall.normal.z();
      touching.overlap[n] = overlap;
      ++n;
    }
    mark_touching(near, block, mask);
    touching.take(near, block, mask);
  }
  touching.finish();
}

/// Second pass: the contact law against walls of infinite mass and radius, R* = r, m* = m.
template <RollingModel kModel>
REPOSE_INLINE void wall_block(const ForceStep& step, Bodies& bodies, ForceKernels::Placed placed,
                              NearList& near, std::span<const Wall> walls, const TouchingWalls& touching,
                              std::size_t first, PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  std::array<const Wall*, kSimdWidth> wall;
  const std::size_t lanes = std::min(kSimdWidth, touching.count - first);
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    wall[lane] = &walls[static_cast<std::size_t>(touching.placed_b[first + lane])];
  const std::int32_t *body = touching.body_a.data() + first, *at_history = touching.history.data() + first;
  const auto i = load_side<SimdReal>(bodies, placed, touching.placed_a.data() + first, body);
  ContactGeometry<SimdReal> contact;
  contact.n = {load(touching.nx, first), load(touching.ny, first), load(touching.nz, first)};
  contact.overlap = load(touching.overlap, first);
  contact.R_eff = i.radius;
  contact.m_eff = i.mass;
  contact.inverse_m_eff = 1.0 / i.mass;
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

  const auto motion = relative_motion<SimdReal>(contact.n, {i.velocity, i.w, arm}, {v_wall, none, none});
  Triple<SimdReal> lead;
  ContactTiming<SimdReal> timing{step.dt, step.lag, step.booked, nullptr};
  if (step.leads) {
    lead = lead_of<SimdReal>(bodies, body, arm);
    timing.lead = &lead;
  }
  ContactHistory<SimdReal> history = load_history<SimdReal>(near, at_history, kSpring);
  const ContactForces<SimdReal> f = contact_forces<kModel>(step.wall_law, contact, motion, timing, history);
  store_history(history, near, at_history, lanes, kSpring);
  if (step.booked) {
    sum.add(f.power, lanes);
    sum.add_wall(dot(f.force, v_wall), lanes);
  }
  SimdReal resist = 0.0;
  if constexpr (kModel == RollingModel::type_a)
    resist = step.wall_law.rolling * absolute(f.F_n) * length(arm);
  add_fields8(load_fields(f.force, resist, cross(arm, f.force) + f.rolling_torque), body,
              bodies.load.data()->force, lanes);
}

template <RollingModel kModel>
ContactWork wall_forces(const ForceStep& step, Bodies& bodies, ForceKernels::Placed placed, NearList& near,
                        std::span<const Wall> walls, TouchingWalls& touching) {
  find_touching_walls(placed, near, walls, touching);
  PowerSum sum;
  for (std::size_t first = 0; first < touching.count; first += kSimdWidth)
    wall_block<kModel>(step, bodies, placed, near, walls, touching, first, sum);
  return sum.work(step.dt);
}

}  // namespace repose
