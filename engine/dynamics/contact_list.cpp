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
  const bool walls_listed = list_level_2 && list_candidates(bodies, walls, list_level_1);
  look_near(bodies, walls, walls_used_up || walls_listed);
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
}

/// Where the bodies and spheres of before are now; kDropped: gone.
struct ContactList::Renumbering {
  static constexpr std::int32_t kDropped = -1;
  std::span<const int> body;
  std::vector<std::size_t> old_first;   ///< sphere of each body, and one past the last
  std::vector<std::int32_t> new_first;  ///< of each body

  [[nodiscard]] std::int32_t moved(std::int32_t sphere, std::size_t of_body) const {
    return sphere - static_cast<std::int32_t>(old_first[of_body]) + new_first[of_body];
  }
  [[nodiscard]] std::int32_t new_place(std::int32_t sphere) const {
    const auto after = std::ranges::upper_bound(old_first, static_cast<std::size_t>(sphere));
    const auto of_body = static_cast<std::size_t>(after - old_first.begin() - 1);
    return new_first[of_body] == kDropped ? kDropped : moved(sphere, of_body);
  }
};

void ContactList::renumber(const Bodies& bodies, std::span<const int> new_index) {
  const Renumbering to = move_spheres(new_index);
  const auto new_place = [&to](std::int32_t sphere) { return to.new_place(sphere); };
  near_pairs.renumber(new_place, placed);
  near_walls.renumber(new_place, placed);
  renumber_candidates(to);
  for (auto* array : {&until_.bodies, &until_.spheres, &until_.near})
    for (std::size_t i = 0; i < new_index.size(); ++i)
      if (new_index[i] >= 0) (*array)[static_cast<std::size_t>(new_index[i])] = (*array)[i];
  until_.resize(bodies.count, bodies.padded());
  link_pairs(bodies.count);
  gather_near();
}

/// Spheres of the bodies that stay move down to their new places.
ContactList::Renumbering ContactList::move_spheres(std::span<const int> new_index) {
  Renumbering renumbering{new_index, std::move(first_sphere_), {}};
  const std::vector<std::size_t>& old_first = renumbering.old_first;
  first_sphere_.clear();
  std::size_t to = 1;
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    const bool stays = new_index[i] >= 0;
    renumbering.new_first.push_back(stays ? static_cast<std::int32_t>(to) : Renumbering::kDropped);
    if (!stays) continue;
    first_sphere_.push_back(to);
    for (std::size_t s = old_first[i]; s < old_first[i + 1]; ++s, ++to) {
      placed[to] = placed[s];
      placed[to].body = new_index[i];
    }
  }
  first_sphere_.push_back(to);
  placed.resize(to);
  is_needed_.assign(to, 0);
  needed_.clear();
  return renumbering;
}

/// Candidates of dropped bodies go; the others keep their order, because renumbering keeps the order of
/// bodies.
void ContactList::renumber_candidates(const Renumbering& to) {
  std::swap(old_, pairs_);
  pairs_.clear();
  std::vector<BodyPair> kept_pairs;
  std::vector<std::size_t> kept_begin(1, 0);
  for (std::size_t p = 0; p < body_pairs_.size(); ++p) {
    const auto i = static_cast<std::size_t>(body_pairs_[p].i), j = static_cast<std::size_t>(body_pairs_[p].j);
    if (to.body[i] < 0 || to.body[j] < 0) continue;
    kept_pairs.push_back({to.body[i], to.body[j]});
    for (std::size_t c = pair_begin_[p]; c < pair_begin_[p + 1]; ++c)
      pairs_.push(to.moved(old_.a[c], i), to.moved(old_.b[c], j), old_.near[c]);
    kept_begin.push_back(pairs_.count());
  }
  body_pairs_ = std::move(kept_pairs);
  pair_begin_ = std::move(kept_begin);

  std::swap(old_, walls_);
  walls_.clear();
  std::vector<std::size_t> kept_wall_begin(1, 0);
  for (std::size_t i = 0; i + 1 < wall_begin_.size(); ++i) {
    if (to.body[i] < 0) continue;
    for (std::size_t c = wall_begin_[i]; c < wall_begin_[i + 1]; ++c)
      walls_.push(to.moved(old_.a[c], i), old_.b[c], old_.near[c]);
    kept_wall_begin.push_back(walls_.count());
  }
  wall_begin_ = std::move(kept_wall_begin);
}

void ContactList::hand_over_wall(int from, int to, double side) {
  const auto on_side = [&](std::size_t sphere) { return placed[sphere].centre[0] * side > 0.0; };
  for (std::size_t c = 0; c < walls_.count(); ++c)
    if (walls_.b[c] == from && on_side(static_cast<std::size_t>(walls_.a[c]))) walls_.b[c] = to;
  for (std::size_t k = 0; k < near_walls.count; ++k)
    if (near_walls.sphere_b[k] == from && on_side(near_walls.first(k))) near_walls.sphere_b[k] = to;
  renumbered_ = true;
}

void ContactList::place(const Bodies& bodies, std::size_t s) {
  PlacedSphere& sphere = placed[s];
  const auto i = static_cast<std::size_t>(sphere.body);
  if (bodies.oriented) {
    place_sphere(bodies.axes[i], local_[static_cast<std::size_t>(sphere.local)], sphere);
  } else {  // single spheres at their bodies' centres: no arms
    sphere.centre[0] = bodies.x[i], sphere.centre[1] = bodies.y[i], sphere.centre[2] = bodies.z[i];
  }
}

void ContactList::place_spheres(const Bodies& bodies) {
  for (const std::int32_t s : needed_) place(bodies, static_cast<std::size_t>(s));
}

}  // namespace repose
