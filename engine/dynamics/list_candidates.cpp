// Levels 1 and 2 of ContactList: pairs of bodies and their candidates.

#include <cmath>
#include <optional>

#include "engine/dynamics/contact_list.hpp"

namespace repose {

/// Sections are listed in two phases: all must have said which bodies are to be listed before their
/// candidates are found.
void ContactList::list_candidates(const Bodies& bodies, std::span<const Wall> walls, Relist anew,
                                  Crew& crew) {
  ++updates_;
  flag_moved(bodies);
  std::optional<CellGrid> grid;
  if (anew.bodies) grid.emplace(search_spheres(bodies), skins_.bodies);
  each_section(crew, [&](Section& section) { begin_listing(section, grid ? &*grid : nullptr); });
  if (anew.bodies)
    for (std::size_t i = 0; i < bodies.count; ++i) until_.bodies[i] = bodies.travel[i] + 0.5 * skins_.bodies;
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

void ContactList::list_pair(const Bodies& bodies, const BodyPair& pair, Reaching& of_i, Reaching& of_j,
                            CandidateArrays& to) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const auto find = [&, origin = bodies.position(i)](std::size_t of, std::size_t into, Reaching& found) {
    found.find(local_, {bodies.shape[of], bodies.axes[of], bodies.position(of), first_sphere_[of]},
               bodies.position(into), bodies.reach[into] + skins_.spheres, origin);
  };
  find(i, j, of_i);
  if (of_i.count == 0) return;
  find(j, i, of_j);
  for_each_near(of_i, of_j, skins_.spheres,
                [&](std::size_t a, std::size_t b) { to.push(of_i.sphere[a], of_j.sphere[b]); });
}

/// Candidates are sorted by body, sphere and wall. Those of bodies that have not moved stay, unless a wall
/// has (`all`).
void ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls, bool all,
                             Section& section) const {
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
                                CandidateArrays& to) const {
  const Vec3 position = bodies.position(i);
  bool near = false;
  for (const Wall& wall : walls)
    near |= wall.present && within_reach(wall, position, bodies.reach[i] + skins_.spheres);
  if (!near) return;
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) {
    const PlacedSphere sphere = placed_now(bodies, i, s);
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].present && within_reach(walls[w], Vec3(sphere.centre), sphere.radius + skins_.spheres))
        to.push(static_cast<std::int32_t>(s), static_cast<std::int32_t>(w));
  }
}

}  // namespace repose
