// Levels 1 and 2 of ContactList: pairs of bodies and their candidates.

#include <bit>
#include <cmath>
#include <optional>

#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// Spheres of one body that reach into the bounding sphere of another.
struct ContactList::Reaching {
  std::vector<std::int32_t> sphere;     ///< in `placed`
  std::vector<double> x, y, z, radius;  ///< padded to whole vectors with spheres that are far from all
  std::size_t count = 0;
};

/// Sections are listed in phases, since a pair needs the spheres of bodies of other sections: which bodies
/// are to be listed, whose spheres that takes, these placed, and the candidates.
void ContactList::list_candidates(const Bodies& bodies, std::span<const Wall> walls, Relist anew,
                                  Crew& crew) {
  ++updates_;
  flag_moved(bodies);
  std::optional<CellGrid> grid;
  if (anew.bodies) grid.emplace(search_spheres(bodies), skins_.bodies);
  each_section(crew, [&](Section& section) { begin_listing(section, grid ? &*grid : nullptr); });
  if (anew.bodies)
    for (std::size_t i = 0; i < bodies.count; ++i) until_.bodies[i] = bodies.travel[i] + 0.5 * skins_.bodies;
  each_section(crew, [&](const Section& section) { flag_to_place(bodies, section); });
  each_section(crew, [&](const Section& section) {
    for (std::size_t i = section.first; i < section.last; ++i)
      if (to_place_[i]) place_all(bodies, i);
  });
  each_section(crew, [&](Section& section) {
    list_pairs(bodies, section);
    list_walls(bodies, walls, anew.walls, section);
    for (std::size_t i = section.first; i < section.last; ++i) {
      if (!moved_[i]) continue;
      until_.spheres[i] = bodies.travel[i] + 0.5 * skins_.spheres;
      is_looked_[i] = 1;
    }
  });
}

SearchSpheres ContactList::search_spheres(const Bodies& bodies) {
  const auto first = [n = bodies.count](const std::vector<double>& array) {
    return std::span(array.data(), n);
  };
  return {first(bodies.x), first(bodies.y), first(bodies.z), first(bodies.reach)};
}

/// Bodies that have used more than half of their share are listed with those that have used all of it, so
/// that listings of single bodies come in batches.
void ContactList::flag_moved(const Bodies& bodies) {
  moved_.resize(bodies.count);
  for (std::size_t i = 0; i < bodies.count; ++i)
    moved_[i] = bodies.travel[i] > until_.spheres[i] - 0.25 * skins_.spheres;
  to_place_.assign(bodies.count, 0);
}

/// Sets the lists of before aside. With a grid the pairs of bodies are found anew; a pair that was not near
/// before has no candidates to keep: both its bodies are listed anew.
void ContactList::begin_listing(Section& section, const CellGrid* grid) {
  std::swap(section.old, section.lists);
  std::vector<BodyPair>& pairs = section.lists.body_pairs;
  const std::vector<BodyPair>& old_pairs = section.old.body_pairs;
  if (grid == nullptr) {
    pairs = old_pairs;
    return;
  }
  pairs.clear();
  for (std::size_t i = section.first; i < section.last; ++i) grid->append_pairs_of(i, pairs);
  auto old = old_pairs.begin();
  for (const BodyPair& pair : pairs) {
    while (old != old_pairs.end() && *old < pair) ++old;
    if (old != old_pairs.end() && *old == pair) continue;
    raise(moved_[static_cast<std::size_t>(pair.i)]);
    raise(moved_[static_cast<std::size_t>(pair.j)]);
  }
}

bool ContactList::is_to_list(const BodyPair& pair) const {
  return moved_[static_cast<std::size_t>(pair.i)] || moved_[static_cast<std::size_t>(pair.j)];
}

bool ContactList::in_reach(const Bodies& bodies, const BodyPair& pair) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double dx = bodies.x[i] - bodies.x[j], dy = bodies.y[i] - bodies.y[j], dz = bodies.z[i] - bodies.z[j];
  const double bounds = bodies.reach[i] + bodies.reach[j] + skins_.spheres;
  return dx * dx + dy * dy + dz * dz < bounds * bounds;
}

void ContactList::flag_to_place(const Bodies& bodies, const Section& section) {
  for (const BodyPair& pair : section.lists.body_pairs) {
    if (!is_to_list(pair) || !in_reach(bodies, pair)) continue;
    raise(to_place_[static_cast<std::size_t>(pair.i)]);
    raise(to_place_[static_cast<std::size_t>(pair.j)]);
  }
}

/// Candidates of pairs that have not moved stay, and are taken over as long rows.
void ContactList::list_pairs(const Bodies& bodies, Section& section) const {
  Section::Lists& lists = section.lists;
  const Section::Lists& old = section.old;
  lists.pairs.clear();
  lists.pair_begin.assign(1, 0);
  std::size_t known = 0, begin = 0, end = 0;  // candidates of `old` to be taken over
  const auto take_over = [&] {
    lists.pairs.append(old.pairs, begin, end);
    begin = end = 0;
  };
  Reaching of_i, of_j;
  for (const BodyPair& pair : lists.body_pairs) {
    while (known < old.body_pairs.size() && old.body_pairs[known] < pair) ++known;
    if (is_to_list(pair)) {
      take_over();
      if (in_reach(bodies, pair)) list_pair(bodies, pair, of_i, of_j, lists.pairs);
    } else {
      if (end != old.pair_begin[known]) {
        take_over();
        begin = old.pair_begin[known];
      }
      end = old.pair_begin[known + 1];
    }
    lists.pair_begin.push_back(lists.pairs.count() + (end - begin));
  }
  take_over();
}

void ContactList::place_all(const Bodies& bodies, std::size_t i) {
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) place(bodies, placed[s]);
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

void ContactList::list_pair(const Bodies& bodies, const BodyPair& pair, Reaching& of_i, Reaching& of_j,
                            CandidateArrays& to) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  find_reaching(bodies, i, j, of_i);
  if (of_i.count == 0) return;
  find_reaching(bodies, j, i, of_j);
  for (std::size_t a = 0; a < of_i.count; ++a) {
    const SimdReal x = of_i.x[a], y = of_i.y[a], z = of_i.z[a];
    const SimdReal r = of_i.radius[a] + skins_.spheres;
    for (std::size_t b = 0; b < of_j.count; b += kSimdWidth) {
      const SimdReal px = x - load(of_j.x, b), py = y - load(of_j.y, b), pz = z - load(of_j.z, b);
      const SimdReal reach = r + load(of_j.radius, b);
      for (unsigned near = less_bits(px * px + py * py + pz * pz, reach * reach); near != 0; near &= near - 1)
        to.push(of_i.sphere[a], of_j.sphere[b + static_cast<std::size_t>(std::countr_zero(near))]);
    }
  }
}

/// Candidates are sorted by body, sphere and wall. Those of bodies that have not moved stay, unless a wall
/// has (`all`).
void ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls, bool all, Section& section) {
  Section::Lists& lists = section.lists;
  const Section::Lists& old = section.old;
  lists.walls.clear();
  lists.wall_begin.assign(1, 0);
  for (std::size_t k = 0; section.first + k < section.last; ++k) {
    const std::size_t i = section.first + k;
    const bool known = k + 1 < old.wall_begin.size();
    if (all || moved_[i] || !known)
      list_walls_of(bodies, i, walls, lists.walls);
    else
      lists.walls.append(old.walls, old.wall_begin[k], old.wall_begin[k + 1]);
    lists.wall_begin.push_back(lists.walls.count());
  }
}

void ContactList::list_walls_of(const Bodies& bodies, std::size_t i, std::span<const Wall> walls,
                                CandidateArrays& to) {
  const Vec3 position = bodies.position(i);
  bool near = false;
  for (const Wall& wall : walls)
    near |= wall.present && within_reach(wall, position, bodies.reach[i] + skins_.spheres);
  if (!near) return;
  // Where a pair needs them too they are placed, and other sections may be reading them.
  if (!to_place_[i]) place_all(bodies, i);
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s)
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].present &&
          within_reach(walls[w], Vec3(placed[s].centre), placed[s].radius + skins_.spheres))
        to.push(static_cast<std::int32_t>(s), static_cast<std::int32_t>(w));
}

}  // namespace repose
