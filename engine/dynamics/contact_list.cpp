#include "engine/dynamics/contact_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "engine/contact/simd.hpp"
#include "engine/dynamics/place_sphere.hpp"

namespace repose {

void ContactList::Until::resize(std::size_t count, std::size_t padded) {
  for (auto* array : {&bodies, &spheres, &near}) {
    array->resize(count);
    array->resize(padded, std::numeric_limits<double>::infinity());
  }
}

/// Several threads may write the same 1 at the same time.
void ContactList::raise(Flag& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }

/// Padding falls for ever, but has no end to its share.
bool ContactList::any_used_up(const Bodies& bodies) const {
  for (std::size_t first = 0; first < bodies.padded(); first += kSimdWidth)
    if (!stdx::all_of(load(bodies.travel, first) <= load(until_.near, first))) return true;
  return false;
}

/// Whether a wall that is there has moved by more than `share`, or is another than it was.
bool ContactList::walls_moved(std::span<const Wall> now, std::span<const Wall> then, double share) {
  if (now.size() != then.size()) return true;
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (now[k].kind != then[k].kind || now[k].present != then[k].present) return true;
    const double moved =
        std::abs(now[k].x_offset - then[k].x_offset) + std::abs(now[k].z_low - then[k].z_low);
    if (now[k].present && moved > share) return true;
  }
  return false;
}

bool ContactList::update(const Bodies& bodies, std::span<const Wall> walls, Crew& crew) {
  const bool walls_used_up = walls_moved(walls, looked_walls_, wall_share_);
  if (!renumbered_ && !walls_used_up && !any_used_up(bodies)) return true;

  bool list_level_1 = false, list_level_2 = renumbered_;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    if (bodies.travel[i] <= until_.near[i]) continue;
    if (!(std::abs(bodies.x[i]) < kFarthest && std::abs(bodies.y[i]) < kFarthest &&
          std::abs(bodies.z[i]) < kFarthest && std::isfinite(bodies.travel[i])))
      return false;
    list_level_1 |= bodies.travel[i] > until_.bodies[i];
    list_level_2 |= bodies.travel[i] > until_.spheres[i];
  }
  const bool walls_to_list =
      renumbered_ || (walls_used_up && walls_moved(walls, listed_walls_, 0.5 * skins_.spheres));
  list_level_2 |= list_level_1 || walls_to_list;

  is_looked_.assign(bodies.count, 0);
  if (walls_to_list) listed_walls_.assign(walls.begin(), walls.end());
  if (list_level_2) list_candidates(bodies, walls, {.bodies = list_level_1, .walls = walls_to_list}, crew);
  look_near(bodies, walls, walls_used_up || walls_to_list, crew);
  renumbered_ = false;
  return true;
}

void ContactList::copy_shapes(const Bodies& bodies) {
  for (const Clump& shape : bodies.shapes) {
    local_of_shape_.push_back(static_cast<std::int32_t>(local_.size()));
    for (const Sphere& sphere : shape.spheres)
      local_.push_back({{sphere.centre.x(), sphere.centre.y(), sphere.centre.z()}, sphere.radius});
  }
}

void ContactList::append_spheres(const Bodies& bodies, std::size_t i) {
  if (local_.empty()) copy_shapes(bodies);
  std::int32_t local = local_of_shape_[static_cast<std::size_t>(bodies.shape[i])];
  for (const Sphere& sphere : bodies.spheres(i)) {
    PlacedSphere& to = placed.emplace_back();
    to.radius = bodies.scale[i] * sphere.radius;
    to.body = static_cast<std::int32_t>(i);
    to.local = local++;
  }
}

void ContactList::add_body(const Bodies& bodies) {
  const std::size_t i = bodies.count - 1;
  until_.resize(i, bodies.padded());
  for (auto* until : {&until_.bodies, &until_.spheres, &until_.near}) (*until)[i] = -1.0;
  append_spheres(bodies, i);
  first_sphere_.push_back(placed.size());
  is_needed_.resize(placed.size(), 0);
  if (i % section_bodies_ == 0) sections.emplace_back(i, rolls_);
  sections.back().last = i + 1;
}

void ContactList::hand_over_wall(int from, int to, double side) {
  const auto on_side = [&](std::size_t sphere) { return placed[sphere].centre[0] * side > 0.0; };
  for (Section& section : sections) {
    CandidateArrays& walls = section.lists.walls;
    for (std::size_t c = 0; c < walls.count(); ++c)
      if (walls.b[c] == from && on_side(static_cast<std::size_t>(walls.a[c]))) walls.b[c] = to;
    NearList& near = section.near_walls;
    for (std::size_t k = 0; k < near.count; ++k)
      if (near.sphere_b[k] == from && on_side(near.first(k))) near.sphere_b[k] = to;
  }
  renumbered_ = true;
}

void ContactList::place(const Bodies& bodies, PlacedSphere& sphere) const {
  const auto i = static_cast<std::size_t>(sphere.body);
  if (bodies.oriented) {
    place_sphere(bodies.axes[i], local_[static_cast<std::size_t>(sphere.local)], sphere);
  } else {  // single spheres at their bodies' centres: no arms
    sphere.centre[0] = bodies.x[i], sphere.centre[1] = bodies.y[i], sphere.centre[2] = bodies.z[i];
  }
}

void ContactList::place_spheres(const Bodies& bodies, const Section& section) {
  for (const std::int32_t s : section.needed) place(bodies, placed[static_cast<std::size_t>(s)]);
}

}  // namespace repose
