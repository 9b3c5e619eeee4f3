#include "engine/dynamics/contact_list.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/place_sphere.hpp"

namespace repose {

void CandidateArrays::clear() {
  a.clear(), b.clear(), spring.clear(), rolling.clear(), was_touching.clear();
  count = 0;
}

void CandidateArrays::push(std::int32_t first, std::int32_t second, const CandidateArrays& old,
                           std::ptrdiff_t from) {
  if (count % kBlock == 0) was_touching.push_back(0);
  a.push_back(first);
  b.push_back(second);
  const auto source = static_cast<std::size_t>(from);
  const bool remembers = from >= 0 && old.touched(source);
  spring.push_back(remembers ? old.spring[source] : SpringRecord{});
  rolling.push_back(remembers ? old.rolling[source] : RollingRecord{});
  if (remembers)
    was_touching.back() = static_cast<std::uint8_t>(was_touching.back() | (1U << (count % kBlock)));
  ++count;
}

void CandidateArrays::pad(std::int32_t first, std::int32_t second) {
  const std::size_t whole = was_touching.size() * kBlock;
  a.resize(whole, first);
  b.resize(whole, second);
  spring.resize(whole);
  rolling.resize(whole);
}

void ContactList::Reference::resize(std::size_t entries) {
  for (auto* array : {&x, &y, &z, &qw, &qx, &qy, &qz}) array->resize(entries);
}

namespace {

SimdReal squared_distance(const Bodies& bodies, const std::vector<double>& x, const std::vector<double>& y,
                          const std::vector<double>& z, std::size_t first) {
  const SimdReal dx = load(bodies.x, first) - load(x, first), dy = load(bodies.y, first) - load(y, first),
                 dz = load(bodies.z, first) - load(z, first);
  return dx * dx + dy * dy + dz * dz;
}

/// Whether any body's value is above the limit, or not a number. Padding is left out: it falls for ever.
template <class Value>
bool any_beyond(std::size_t count, double limit, Value value) {
  const std::size_t whole = count / kSimdWidth * kSimdWidth;
  for (std::size_t first = 0; first < whole; first += kSimdWidth)
    if (!stdx::all_of(value(first) <= limit)) return true;
  if (whole == count) return false;
  const SimdReal last = value(whole);
  for (std::size_t lane = 0; lane < count - whole; ++lane)
    if (!(last[lane] <= limit)) return true;
  return false;
}

}  // namespace

bool ContactList::bodies_moved(const Bodies& bodies) const {
  return any_beyond(bodies.count, 0.25 * skins_.bodies * skins_.bodies, [&](std::size_t first) {
    return squared_distance(bodies, listed_x_, listed_y_, listed_z_, first);
  });
}

/// Twice (|Δx|² + (2 swing sin(θ/2))²), which is not below the square of their sum; sin²(θ/2) = 1 − (q·q₀)².
SimdReal ContactList::move_squared(const Bodies& bodies, std::size_t first) const {
  SimdReal sum = squared_distance(bodies, listed_.x, listed_.y, listed_.z, first);
  if (bodies.oriented) {
    const SimdReal cosine =
        load(bodies.qw, first) * load(listed_.qw, first) + load(bodies.qx, first) * load(listed_.qx, first) +
        load(bodies.qy, first) * load(listed_.qy, first) + load(bodies.qz, first) * load(listed_.qz, first);
    const SimdReal swing = load(bodies.swing, first);
    sum += 4.0 * swing * swing * (1.0 - cosine * cosine);
  }
  return 2.0 * sum;
}

bool ContactList::spheres_moved(const Bodies& bodies, double share) const {
  return any_beyond(bodies.count, share * share,
                    [&](std::size_t first) { return move_squared(bodies, first); });
}

bool ContactList::walls_moved(std::span<const Wall> walls) const {
  if (walls.size() != listed_walls_.size()) return true;
  const double share = skins_.spheres / 3.0;
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const Wall& now = walls[k];
    const Wall& then = listed_walls_[k];
    if (now.kind != then.kind || now.present != then.present) return true;
    if (std::abs(now.x_offset - then.x_offset) + std::abs(now.z_low - then.z_low) > share) return true;
  }
  return false;
}

bool ContactList::update(const Bodies& bodies, std::span<const Wall> walls) {
  const double share = skins_.spheres / 3.0;
  const bool level_1 = stale_ || bodies_moved(bodies);
  if (!level_1 && !spheres_moved(bodies, share) && !walls_moved(walls)) return true;
  for (std::size_t i = 0; i < bodies.count; ++i)
    if (!(std::abs(bodies.x[i]) < kFarthest && std::abs(bodies.y[i]) < kFarthest &&
          std::abs(bodies.z[i]) < kFarthest))
      return false;

  ++updates_;
  std::swap(old_, pairs);
  std::swap(old_body_pairs_, body_pairs_);
  std::swap(old_pair_begin_, pair_begin_);
  std::swap(old_placed_, placed);
  flag_moved(bodies);
  if (level_1) {
    list_bodies(bodies);
    flag_new_pairs();
  } else {
    body_pairs_ = old_body_pairs_;
  }
  list_pairs(bodies);
  std::swap(old_, wall_contacts);
  list_walls(bodies, walls);
  number_placed(bodies);
  stale_ = false;
  return true;
}

void ContactList::list_bodies(const Bodies& bodies) {
  const std::size_t n = bodies.count;
  const auto first = [n](const std::vector<double>& array) { return std::span(array.data(), n); };
  body_pairs_ =
      near_pairs({first(bodies.x), first(bodies.y), first(bodies.z), first(bodies.reach)}, skins_.bodies);
  listed_x_ = bodies.x, listed_y_ = bodies.y, listed_z_ = bodies.z;
}

/// Bodies that have used more than half of their share are listed with those that have used all of it, so
/// that listings of single bodies come in batches.
void ContactList::flag_moved(const Bodies& bodies) {
  const std::size_t known = std::min(listed_.x.size(), bodies.padded());
  listed_.resize(bodies.padded());
  moved_.assign(bodies.padded(), 1);
  if (stale_) return;
  const double share = skins_.spheres / 6.0;
  for (std::size_t first = 0; first < known; first += kSimdWidth) {
    const SimdReal moved = move_squared(bodies, first);
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane) moved_[first + lane] = moved[lane] > share * share;
  }
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

void ContactList::list_pairs(const Bodies& bodies) {
  first_sphere_.resize(bodies.count + 1);
  first_sphere_[0] = 0;
  for (std::size_t i = 0; i < bodies.count; ++i)
    first_sphere_[i + 1] = first_sphere_[i] + bodies.spheres(i).size();
  all_.resize(first_sphere_.back());
  all_placed_.assign(bodies.count, 0);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    if (!moved_[i]) continue;
    listed_.x[i] = bodies.x[i], listed_.y[i] = bodies.y[i], listed_.z[i] = bodies.z[i];
    listed_.qw[i] = bodies.qw[i], listed_.qx[i] = bodies.qx[i], listed_.qy[i] = bodies.qy[i],
    listed_.qz[i] = bodies.qz[i];
  }

  pairs.clear();
  pair_begin_.assign(1, 0);
  std::size_t old = 0;
  for (const BodyPair& pair : body_pairs_) {
    while (old < old_body_pairs_.size() && old_body_pairs_[old] < pair) ++old;
    const bool known = old < old_body_pairs_.size() && old_body_pairs_[old] == pair;
    const bool moved = moved_[static_cast<std::size_t>(pair.i)] || moved_[static_cast<std::size_t>(pair.j)];
    if (known && !moved)
      keep_pair(old);
    else
      list_pair(bodies, pair, known ? static_cast<std::ptrdiff_t>(old) : -1);
    pair_begin_.push_back(pairs.count);
  }
}

void ContactList::keep_pair(std::size_t old_pair) {
  for (std::size_t c = old_pair_begin_[old_pair]; c < old_pair_begin_[old_pair + 1]; ++c)
    pairs.push(old_placed_[static_cast<std::size_t>(old_.a[c])].sphere,
               old_placed_[static_cast<std::size_t>(old_.b[c])].sphere, old_, static_cast<std::ptrdiff_t>(c));
}

void ContactList::place_all(const Bodies& bodies, std::size_t i) {
  if (all_placed_[i]) return;
  all_placed_[i] = 1;
  const std::vector<Sphere>& spheres = bodies.spheres(i);
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    PlacedSphere& sphere = all_[first_sphere_[i] + s];
    sphere.body = static_cast<std::int32_t>(i);
    sphere.sphere = static_cast<std::int32_t>(s);
    place_sphere(bodies, spheres[s], sphere);
  }
}

void ContactList::list_pair(const Bodies& bodies, const BodyPair& pair, std::ptrdiff_t old_pair) {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  place_all(bodies, i);
  place_all(bodies, j);
  // Spheres of one body that reach into the bounding sphere of the other.
  const auto reaching = [&](std::size_t of, std::size_t into, std::vector<std::int32_t>& list) {
    list.clear();
    for (std::size_t s = first_sphere_[of]; s < first_sphere_[of + 1]; ++s) {
      const double dx = all_[s].centre[0] - bodies.x[into], dy = all_[s].centre[1] - bodies.y[into],
                   dz = all_[s].centre[2] - bodies.z[into];
      const double reach = all_[s].radius + bodies.reach[into] + skins_.spheres;
      if (dx * dx + dy * dy + dz * dz < reach * reach)
        list.push_back(static_cast<std::int32_t>(s - first_sphere_[of]));
    }
  };
  reaching(i, j, near_a_);
  if (near_a_.empty()) return;
  reaching(j, i, near_b_);
  for (const std::int32_t a : near_a_) {
    const PlacedSphere& sa = all_[first_sphere_[i] + static_cast<std::size_t>(a)];
    for (const std::int32_t b : near_b_) {
      const PlacedSphere& sb = all_[first_sphere_[j] + static_cast<std::size_t>(b)];
      const double dx = sa.centre[0] - sb.centre[0], dy = sa.centre[1] - sb.centre[1],
                   dz = sa.centre[2] - sb.centre[2];
      const double reach = sa.radius + sb.radius + skins_.spheres;
      if (dx * dx + dy * dy + dz * dz >= reach * reach) continue;
      std::ptrdiff_t from = -1;
      if (old_pair >= 0) {
        const auto p = static_cast<std::size_t>(old_pair);
        for (std::size_t c = old_pair_begin_[p]; c < old_pair_begin_[p + 1] && from < 0; ++c)
          if (old_placed_[static_cast<std::size_t>(old_.a[c])].sphere == a &&
              old_placed_[static_cast<std::size_t>(old_.b[c])].sphere == b)
            from = static_cast<std::ptrdiff_t>(c);
      }
      pairs.push(a, b, old_, from);
    }
  }
}

/// Every body is tested against every wall that is there: a few operations each. Candidates are sorted by
/// body, sphere and wall, as the old ones are, so that one pass over both finds what a contact remembers.
void ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls) {
  listed_walls_.assign(walls.begin(), walls.end());
  wall_contacts.clear();
  std::size_t old = 0;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const Vec3 position = bodies.position(i);
    bool near = false;
    for (const Wall& wall : walls)
      near |= wall.present && distance_to(wall, position).distance < bodies.reach[i] + skins_.spheres;
    if (!near) continue;
    place_all(bodies, i);
    for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) {
      const Vec3 centre(all_[s].centre);
      const auto sphere = static_cast<std::int32_t>(s - first_sphere_[i]);
      for (std::size_t w = 0; w < walls.size(); ++w) {
        if (!walls[w].present || distance_to(walls[w], centre).distance >= all_[s].radius + skins_.spheres)
          continue;
        const auto before = [&](std::size_t c) {
          const PlacedSphere& other = old_placed_[static_cast<std::size_t>(old_.a[c])];
          if (other.body != static_cast<std::int32_t>(i)) return other.body < static_cast<std::int32_t>(i);
          if (other.sphere != sphere) return other.sphere < sphere;
          return old_.b[c] < static_cast<std::int32_t>(w);
        };
        while (old < old_.count && before(old)) ++old;
        const bool known =
            old < old_.count &&
            old_placed_[static_cast<std::size_t>(old_.a[old])].body == static_cast<std::int32_t>(i) &&
            old_placed_[static_cast<std::size_t>(old_.a[old])].sphere == sphere &&
            old_.b[old] == static_cast<std::int32_t>(w);
        // Until number_placed the first index is the sphere's among all spheres.
        wall_contacts.push(static_cast<std::int32_t>(s), static_cast<std::int32_t>(w), old_,
                           known ? static_cast<std::ptrdiff_t>(old) : -1);
      }
    }
  }
}

/// Gives every sphere that some candidate needs a place in `placed` and lets the candidates point there.
void ContactList::number_placed(const Bodies& bodies) {
  number_.assign(first_sphere_.back(), -1);
  for (std::size_t p = 0; p < body_pairs_.size(); ++p) {
    const std::size_t first_i = first_sphere_[static_cast<std::size_t>(body_pairs_[p].i)];
    const std::size_t first_j = first_sphere_[static_cast<std::size_t>(body_pairs_[p].j)];
    for (std::size_t c = pair_begin_[p]; c < pair_begin_[p + 1]; ++c) {
      pairs.a[c] += static_cast<std::int32_t>(first_i);
      pairs.b[c] += static_cast<std::int32_t>(first_j);
      number_[static_cast<std::size_t>(pairs.a[c])] = number_[static_cast<std::size_t>(pairs.b[c])] = 0;
    }
  }
  for (std::size_t c = 0; c < wall_contacts.count; ++c)
    number_[static_cast<std::size_t>(wall_contacts.a[c])] = 0;

  placed.clear();
  local_.clear();
  for (std::size_t i = 0; i < bodies.count; ++i)
    for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) {
      if (number_[s] < 0) continue;
      number_[s] = static_cast<std::int32_t>(placed.size());
      PlacedSphere& sphere = placed.emplace_back();
      sphere.body = static_cast<std::int32_t>(i);
      sphere.sphere = static_cast<std::int32_t>(s - first_sphere_[i]);
      const Sphere& local = bodies.spheres(i)[s - first_sphere_[i]];
      const double scale = bodies.scale[i];
      sphere.radius = scale * local.radius;
      local_.push_back({scale * local.centre.x(), scale * local.centre.y(), scale * local.centre.z(), 0.0});
    }
  const auto dummy = static_cast<std::int32_t>(placed.size());
  placed.emplace_back();  // radius 0: at distance 0 from itself, it never touches

  for (std::size_t c = 0; c < pairs.count; ++c) {
    pairs.a[c] = number_[static_cast<std::size_t>(pairs.a[c])];
    pairs.b[c] = number_[static_cast<std::size_t>(pairs.b[c])];
  }
  for (std::size_t c = 0; c < wall_contacts.count; ++c)
    wall_contacts.a[c] = number_[static_cast<std::size_t>(wall_contacts.a[c])];
  pairs.pad(dummy, dummy);
  wall_contacts.pad(dummy, 0);
}

void ContactList::renumber(std::span<const int> new_index) {
  // Candidates of dropped bodies go; the others keep their order, because renumbering keeps the order of
  // bodies.
  CandidateArrays kept;
  std::vector<BodyPair> kept_pairs;
  std::vector<std::size_t> kept_begin(1, 0);
  for (std::size_t p = 0; p < body_pairs_.size(); ++p) {
    const int i = new_index[static_cast<std::size_t>(body_pairs_[p].i)];
    const int j = new_index[static_cast<std::size_t>(body_pairs_[p].j)];
    if (i < 0 || j < 0) continue;
    kept_pairs.push_back({i, j});
    for (std::size_t c = pair_begin_[p]; c < pair_begin_[p + 1]; ++c)
      kept.push(pairs.a[c], pairs.b[c], pairs, static_cast<std::ptrdiff_t>(c));
    kept_begin.push_back(kept.count);
  }
  CandidateArrays kept_walls;
  for (std::size_t c = 0; c < wall_contacts.count; ++c)
    if (new_index[static_cast<std::size_t>(placed[static_cast<std::size_t>(wall_contacts.a[c])].body)] >= 0)
      kept_walls.push(wall_contacts.a[c], wall_contacts.b[c], wall_contacts, static_cast<std::ptrdiff_t>(c));
  for (PlacedSphere& sphere : placed)
    sphere.body = std::max(new_index[static_cast<std::size_t>(sphere.body)], 0);
  pairs = std::move(kept);
  wall_contacts = std::move(kept_walls);
  body_pairs_ = std::move(kept_pairs);
  pair_begin_ = std::move(kept_begin);
  invalidate();
}

void ContactList::hand_over_wall(int from, int to, double side) {
  for (std::size_t c = 0; c < wall_contacts.count; ++c)
    if (wall_contacts.b[c] == from &&
        placed[static_cast<std::size_t>(wall_contacts.a[c])].centre[0] * side > 0.0)
      wall_contacts.b[c] = to;
  invalidate();
}

void ContactList::place_spheres(const Bodies& bodies) {
  const std::size_t count = placed.size() - 1;
  if (!bodies.oriented) {  // single spheres at their bodies' centres: no arms
    for (std::size_t s = 0; s < count; ++s) {
      const auto i = static_cast<std::size_t>(placed[s].body);
      placed[s].centre[0] = bodies.x[i], placed[s].centre[1] = bodies.y[i], placed[s].centre[2] = bodies.z[i];
    }
    return;
  }
  for (std::size_t s = 0; s < count; ++s) {
    PlacedSphere& sphere = placed[s];
    const auto i = static_cast<std::size_t>(sphere.body);
    const double(&axis)[3][4] = bodies.axes[i].column;
    const double* local = local_[s].data();
    double arm[4];
    for (std::size_t k = 0; k < 4; ++k)
      arm[k] = axis[0][k] * local[0] + axis[1][k] * local[1] + axis[2][k] * local[2];
    sphere.arm[0] = arm[0], sphere.arm[1] = arm[1], sphere.arm[2] = arm[2];
    sphere.centre[0] = bodies.x[i] + arm[0], sphere.centre[1] = bodies.y[i] + arm[1],
    sphere.centre[2] = bodies.z[i] + arm[2];
  }
}

}  // namespace repose
