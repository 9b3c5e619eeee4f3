#include "engine/dynamics/contact_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "engine/contact/simd.hpp"
#include "engine/dynamics/place_sphere.hpp"

namespace repose {

namespace {

/// A body's only sphere, at its centre of mass.
PlacedSphere placed_alone(const Bodies& bodies, std::size_t i, const LocalSphere& local) {
  return {{bodies.x[i], bodies.y[i], bodies.z[i]}, bodies.scale[i] * local.radius};
}

}  // namespace

void ContactList::Until::resize(std::size_t count, std::size_t padded) {
  for (auto* array : {&bodies, &spheres, &walls, &near}) {
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

/// Of a sphere of body i, its row in LocalSpheres.
std::size_t ContactList::local_row(const Bodies& bodies, std::size_t i, std::size_t sphere) const {
  return static_cast<std::size_t>(local_.first_row[static_cast<std::size_t>(bodies.shape[i])]) + sphere -
         first_sphere_[i];
}

/// A sphere of body i where the body is now.
PlacedSphere ContactList::placed_now(const Bodies& bodies, std::size_t i, std::size_t sphere) const {
  const LocalSphere& local = local_.rows[local_row(bodies, i, sphere)];
  PlacedSphere at = placed_alone(bodies, i, local);
  if (bodies.oriented) place_sphere(bodies.axes[i], local, at);
  return at;
}

void ContactList::add_body(const Bodies& bodies) {
  ++changes_;
  const std::size_t i = bodies.count - 1;
  until_.resize(i, bodies.padded());
  for (auto* until : {&until_.bodies, &until_.spheres, &until_.walls, &until_.near}) (*until)[i] = -1.0;
  const std::size_t spheres = first_sphere_.back() + bodies.spheres(i).size();
  first_sphere_.push_back(spheres);
  placed.resize(spheres);
  place_of_.resize(spheres);
  is_needed_.resize(spheres, 0);
  if (i % section_bodies_ == 0) sections.emplace_back(i, rolls_);
  sections.back().last = i + 1;
}

void ContactList::hand_over_wall(int from, int to, double side) {
  for (Section& section : sections) {
    CandidateArrays& walls = section.lists.walls;
    NearList& near = section.near_walls;
    std::size_t k = 0;  // the near ones are those whose flag is set; the next update lists all anew
    for (const CandidateSlot& slot : section.lists.wall_slots)
      for (std::size_t c = slot.begin; c < slot.begin + slot.count; ++c) {
        if (walls.near[c] == 0) continue;
        if (walls.b[c] == from && near.first(placed, k).centre[0] * side > 0.0) {
          walls.b[c] = to;
          near.set_wall(k, to);
        }
        ++k;
      }
  }
  renumbered_ = true;
}

void ContactList::place_spheres(const Bodies& bodies, const Section& section) {
  PlacedSphere* to = placed.data() + first_sphere_[section.first];
  if (bodies.oriented) {
    for (const Section::Needed& needed : section.needed)
      place_sphere(bodies.axes[static_cast<std::size_t>(needed.body)],
                   local_.rows[static_cast<std::size_t>(needed.local)], *to++);
  } else {
    for (const Section::Needed& needed : section.needed)
      *to++ = placed_alone(bodies, static_cast<std::size_t>(needed.body),
                           local_.rows[static_cast<std::size_t>(needed.local)]);
  }
}

}  // namespace repose
