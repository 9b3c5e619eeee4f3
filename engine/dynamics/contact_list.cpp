#include "engine/dynamics/contact_list.hpp"

#include <algorithm>
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

bool ContactList::update(const Bodies& bodies, std::span<const Wall> walls) {
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
  list_level_2 |= list_level_1 || (walls_used_up && walls_moved(walls, listed_walls_, 0.5 * skins_.spheres));

  is_looked_.assign(bodies.count, 0);
  if (list_level_1) {
    std::swap(old_body_pairs_, body_pairs_);
    list_bodies(bodies);
  }
  if (list_level_2) list_candidates(bodies, walls, list_level_1);
  look_near(bodies, walls, walls_used_up);
  renumbered_ = false;
  return true;
}

void ContactList::list_bodies(const Bodies& bodies) {
  const std::size_t n = bodies.count;
  const auto first = [n](const std::vector<double>& array) { return std::span(array.data(), n); };
  body_pairs_ = repose::near_pairs({first(bodies.x), first(bodies.y), first(bodies.z), first(bodies.reach)},
                                   skins_.bodies);
  for (std::size_t i = 0; i < n; ++i) until_.bodies[i] = bodies.travel[i] + 0.5 * skins_.bodies;
  link_pairs(n);
}

/// From a body to its pairs.
void ContactList::link_pairs(std::size_t count) {
  pair_first_.assign(count + 1, 0);
  second_first_.assign(count + 1, 0);
  for (const BodyPair& pair : body_pairs_) {
    ++pair_first_[static_cast<std::size_t>(pair.i) + 1];
    ++second_first_[static_cast<std::size_t>(pair.j) + 1];
  }
  for (std::size_t i = 0; i < count; ++i) {
    pair_first_[i + 1] += pair_first_[i];
    second_first_[i + 1] += second_first_[i];
  }
  second_.resize(body_pairs_.size());
  std::vector<std::size_t>& next = next_;
  next.assign(second_first_.begin(), second_first_.end());
  for (std::size_t p = 0; p < body_pairs_.size(); ++p)
    second_[next[static_cast<std::size_t>(body_pairs_[p].j)]++] = p;
}

void ContactList::number_spheres(const Bodies& bodies) {
  first_sphere_.resize(bodies.count + 1);
  placed.resize(1);
  local_.resize(1);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    first_sphere_[i] = placed.size();
    append_spheres(bodies, i);
  }
  first_sphere_.back() = placed.size();
  is_needed_.assign(placed.size(), 0);
}

void ContactList::append_spheres(const Bodies& bodies, std::size_t i) {
  const double scale = bodies.scale[i];
  std::int32_t number = 0;
  for (const Sphere& sphere : bodies.spheres(i)) {
    PlacedSphere& to = placed.emplace_back();
    to.radius = scale * sphere.radius;
    to.body = static_cast<std::int32_t>(i);
    to.sphere = number++;
    local_.push_back(local_sphere(sphere, scale));
  }
}

void ContactList::add_body(const Bodies& bodies) {
  const std::size_t i = bodies.count - 1;
  until_.resize(i, bodies.padded());
  for (auto* until : {&until_.bodies, &until_.spheres, &until_.near}) (*until)[i] = -1.0;
  append_spheres(bodies, i);
  first_sphere_.push_back(placed.size());
  is_needed_.resize(placed.size(), 0);
}

void ContactList::renumber(const Bodies& bodies, std::span<const int> new_index) {
  const std::vector<std::size_t> old_first = first_sphere_;
  const std::vector<PlacedSphere> old_placed = placed;
  number_spheres(bodies);
  const auto index_of = [&](std::int32_t body) { return new_index[static_cast<std::size_t>(body)]; };
  const auto sphere_of = [&](std::int32_t old) {
    const PlacedSphere& sphere = old_placed[static_cast<std::size_t>(old)];
    const std::size_t now = first_sphere_[static_cast<std::size_t>(index_of(sphere.body))] +
                            static_cast<std::size_t>(sphere.sphere);
    for (std::size_t k = 0; k < 3; ++k)
      placed[now].centre[k] = sphere.centre[k], placed[now].arm[k] = sphere.arm[k];
    return static_cast<std::int32_t>(now);
  };

  // Candidates of dropped bodies go; the others keep their order, because renumbering keeps the order of
  // bodies.
  CandidateArrays kept;
  kept.rolls = pairs.rolls;
  std::vector<BodyPair> kept_pairs;
  std::vector<std::size_t> kept_begin(1, 0);
  for (std::size_t p = 0; p < body_pairs_.size(); ++p) {
    const int i = index_of(body_pairs_[p].i), j = index_of(body_pairs_[p].j);
    if (i < 0 || j < 0) continue;
    kept_pairs.push_back({i, j});
    for (std::size_t c = pair_begin_[p]; c < pair_begin_[p + 1]; ++c)
      kept.push(sphere_of(pairs.a[c]), sphere_of(pairs.b[c]), pairs, static_cast<std::ptrdiff_t>(c));
    kept_begin.push_back(kept.count);
  }
  CandidateArrays kept_walls;
  kept_walls.rolls = pairs.rolls;
  std::vector<std::size_t> kept_wall_begin(1, 0);
  for (std::size_t i = 0; i + 1 < wall_begin_.size(); ++i) {
    if (new_index[i] < 0) continue;
    for (std::size_t c = wall_begin_[i]; c < wall_begin_[i + 1]; ++c)
      kept_walls.push(sphere_of(wall_contacts.a[c]), wall_contacts.b[c], wall_contacts,
                      static_cast<std::ptrdiff_t>(c));
    kept_wall_begin.push_back(kept_walls.count);
  }
  for (auto* array : {&until_.bodies, &until_.spheres, &until_.near})
    for (std::size_t i = 0; i < new_index.size(); ++i)
      if (new_index[i] >= 0) (*array)[static_cast<std::size_t>(new_index[i])] = (*array)[i];
  until_.resize(bodies.count, bodies.padded());

  pairs = std::move(kept);
  wall_contacts = std::move(kept_walls);
  body_pairs_ = std::move(kept_pairs);
  pair_begin_ = std::move(kept_begin);
  wall_begin_ = std::move(kept_wall_begin);
  link_pairs(bodies.count);
  needed_.clear();
  gather_near();
}

void ContactList::hand_over_wall(int from, int to, double side) {
  for (std::size_t c = 0; c < wall_contacts.count; ++c)
    if (wall_contacts.b[c] == from &&
        placed[static_cast<std::size_t>(wall_contacts.a[c])].centre[0] * side > 0.0)
      wall_contacts.b[c] = to;
  renumbered_ = true;
}

void ContactList::place(const Bodies& bodies, std::size_t s) {
  PlacedSphere& sphere = placed[s];
  const auto i = static_cast<std::size_t>(sphere.body);
  if (bodies.oriented) {
    place_sphere(bodies.axes[i], local_[s], sphere);
  } else {  // single spheres at their bodies' centres: no arms
    sphere.centre[0] = bodies.x[i], sphere.centre[1] = bodies.y[i], sphere.centre[2] = bodies.z[i];
  }
}

void ContactList::place_spheres(const Bodies& bodies) {
  for (const std::int32_t s : needed_) place(bodies, static_cast<std::size_t>(s));
}

}  // namespace repose
