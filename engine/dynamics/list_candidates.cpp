// Level 2 of ContactList: candidates.

#include <bit>
#include <cmath>

#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

bool ContactList::list_candidates(const Bodies& bodies, std::span<const Wall> walls, bool bodies_listed) {
  ++updates_;
  flag_moved(bodies);
  if (bodies_listed)
    flag_new_pairs();
  else
    old_body_pairs_ = body_pairs_;
  all_placed_.assign(bodies.count, 0);
  std::swap(old_pair_begin_, pair_begin_);
  std::swap(old_, pairs_);
  list_pairs(bodies);
  std::swap(old_wall_begin_, wall_begin_);
  std::swap(old_, walls_);
  const bool walls_listed = list_walls(bodies, walls);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    if (!moved_[i]) continue;
    until_.spheres[i] = bodies.travel[i] + 0.5 * skins_.spheres;
    is_looked_[i] = 1;
  }
  return walls_listed;
}

/// Bodies that have used more than half of their share are listed with those that have used all of it, so
/// that listings of single bodies come in batches.
void ContactList::flag_moved(const Bodies& bodies) {
  moved_.resize(bodies.count);
  for (std::size_t i = 0; i < bodies.count; ++i)
    moved_[i] = bodies.travel[i] > until_.spheres[i] - 0.25 * skins_.spheres;
}

/// A pair that was not near at the last listing of bodies has no candidates to keep: both bodies are listed
/// anew.
void ContactList::flag_new_pairs() {
  auto old = old_body_pairs_.begin();
  for (const BodyPair& pair : body_pairs_) {
    while (old != old_body_pairs_.end() && *old < pair) ++old;
    if (old == old_body_pairs_.end() || *old != pair)
      moved_[static_cast<std::size_t>(pair.i)] = moved_[static_cast<std::size_t>(pair.j)] = 1;
  }
}

/// Candidates of pairs that have not moved stay, and are taken over as long rows.
void ContactList::list_pairs(const Bodies& bodies) {
  pairs_.clear();
  pair_begin_.assign(1, 0);
  std::size_t old = 0, begin = 0, end = 0;  // candidates of old_ to be taken over
  const auto take_over = [&] {
    pairs_.append(old_, begin, end);
    begin = end = 0;
  };
  for (const BodyPair& pair : body_pairs_) {
    while (old < old_body_pairs_.size() && old_body_pairs_[old] < pair) ++old;
    const bool known = old < old_body_pairs_.size() && old_body_pairs_[old] == pair;
    if (!known || moved_[static_cast<std::size_t>(pair.i)] || moved_[static_cast<std::size_t>(pair.j)]) {
      take_over();
      list_pair(bodies, pair);
    } else {
      if (end != old_pair_begin_[old]) {
        take_over();
        begin = old_pair_begin_[old];
      }
      end = old_pair_begin_[old + 1];
    }
    pair_begin_.push_back(pairs_.count() + (end - begin));
  }
  take_over();
}

void ContactList::place_all(const Bodies& bodies, std::size_t i) {
  if (all_placed_[i]) return;
  all_placed_[i] = 1;
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) place(bodies, s);
}

void ContactList::find_reaching(const Bodies& bodies, std::size_t of, std::size_t into,
                                Reaching& found) const {
  const std::size_t begin = first_sphere_[of], end = first_sphere_[of + 1];
  const std::size_t room = end - begin + kSimdWidth;
  if (found.x.size() < room) {
    found.sphere.resize(room);
    for (auto* array : {&found.x, &found.y, &found.z, &found.radius}) array->resize(room);
  }
  found.count = 0;
  const double reach = bodies.reach[into] + skins_.spheres;
  const double x = bodies.x[into], y = bodies.y[into], z = bodies.z[into];
  for (std::size_t s = begin; s < end; ++s) {
    const PlacedSphere& sphere = placed[s];
    const double dx = sphere.centre[0] - x, dy = sphere.centre[1] - y, dz = sphere.centre[2] - z;
    const double far = sphere.radius + reach;
    const std::size_t k = found.count;
    found.sphere[k] = static_cast<std::int32_t>(s);
    found.x[k] = sphere.centre[0], found.y[k] = sphere.centre[1], found.z[k] = sphere.centre[2];
    found.radius[k] = sphere.radius;
    found.count += dx * dx + dy * dy + dz * dz < far * far ? 1 : 0;  // no branch: half of them are near
  }
  for (std::size_t k = found.count; k % kSimdWidth != 0; ++k) {
    found.x[k] = found.y[k] = found.z[k] = 2.0 * kFarthest;
    found.radius[k] = 0.0;
  }
}

void ContactList::list_pair(const Bodies& bodies, const BodyPair& pair) {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double dx = bodies.x[i] - bodies.x[j], dy = bodies.y[i] - bodies.y[j], dz = bodies.z[i] - bodies.z[j];
  const double bounds = bodies.reach[i] + bodies.reach[j] + skins_.spheres;
  if (dx * dx + dy * dy + dz * dz >= bounds * bounds) return;
  place_all(bodies, i);
  place_all(bodies, j);
  find_reaching(bodies, i, j, reach_a_);
  if (reach_a_.count == 0) return;
  find_reaching(bodies, j, i, reach_b_);
  for (std::size_t a = 0; a < reach_a_.count; ++a) {
    const SimdReal x = reach_a_.x[a], y = reach_a_.y[a], z = reach_a_.z[a];
    const SimdReal r = reach_a_.radius[a] + skins_.spheres;
    for (std::size_t b = 0; b < reach_b_.count; b += kSimdWidth) {
      const SimdReal px = x - load(reach_b_.x, b), py = y - load(reach_b_.y, b), pz = z - load(reach_b_.z, b);
      const SimdReal reach = r + load(reach_b_.radius, b);
      for (unsigned near = less_bits(px * px + py * py + pz * pz, reach * reach); near != 0; near &= near - 1)
        pairs_.push(reach_a_.sphere[a],
                    reach_b_.sphere[b + static_cast<std::size_t>(std::countr_zero(near))]);
    }
  }
}

/// Candidates are sorted by body, sphere and wall. Those of bodies that have not moved stay, unless a wall
/// has.
bool ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls) {
  const bool all = renumbered_ || walls_moved(walls, listed_walls_, 0.5 * skins_.spheres);
  if (all) listed_walls_.assign(walls.begin(), walls.end());
  walls_.clear();
  wall_begin_.assign(1, 0);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const bool known = i + 1 < old_wall_begin_.size();
    if (all || moved_[i] || !known)
      list_walls_of(bodies, i, walls);
    else
      walls_.append(old_, old_wall_begin_[i], old_wall_begin_[i + 1]);
    wall_begin_.push_back(walls_.count());
  }
  return all;
}

void ContactList::list_walls_of(const Bodies& bodies, std::size_t i, std::span<const Wall> walls) {
  const Vec3 position = bodies.position(i);
  bool near = false;
  for (const Wall& wall : walls)
    near |= wall.present && within_reach(wall, position, bodies.reach[i] + skins_.spheres);
  if (!near) return;
  place_all(bodies, i);
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s)
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].present &&
          within_reach(walls[w], Vec3(placed[s].centre), placed[s].radius + skins_.spheres))
        walls_.push(static_cast<std::int32_t>(s), static_cast<std::int32_t>(w));
}

}  // namespace repose
