// Levels 1 and 2 of ContactList: pairs of bodies and their candidates.

#include <cmath>
#include <optional>

#include "engine/dynamics/contact_list.hpp"

namespace repose {

namespace {

/// Part of skins.spheres that a body may travel before its pairs are looked over. A larger one looks them
/// over less often, a smaller one lists fewer of them anew. Figures in tools/bench/NOTES.md.
constexpr double kShare = 0.25;

}  // namespace

void ContactList::list_candidates(const Bodies& bodies, std::span<const Wall> walls, Relist anew,
                                  Crew& crew) {
  ++updates_;
  flag_moved(bodies);
  std::optional<CellGrid> grid;
  if (anew.bodies) grid.emplace(search_spheres(bodies), skins_.bodies);
  each_section(crew, [&](Section& section) {
    if (grid) find_pairs(*grid, section);
    list_pairs(bodies, anew.bodies, section);
    list_walls(bodies, walls, anew.walls, section);
  });
  if (anew.bodies)
    for (std::size_t i = 0; i < bodies.count; ++i) until_.bodies[i] = bodies.travel[i] + 0.5 * skins_.bodies;
}

SearchSpheres ContactList::search_spheres(const Bodies& bodies) {
  const auto first = [n = bodies.count](const std::vector<double>& array) {
    return std::span(array.data(), n);
  };
  return {first(bodies.x), first(bodies.y), first(bodies.z), first(bodies.reach)};
}

/// Bodies that have used more than half of their share are looked over with those that have used all of it,
/// so that this comes in batches.
void ContactList::flag_moved(const Bodies& bodies) {
  const double share = kShare * skins_.spheres;
  moved_.resize(bodies.count);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    moved_[i] = bodies.travel[i] > until_.spheres[i] - 0.5 * share;
    if (moved_[i]) until_.spheres[i] = bodies.travel[i] + share;
  }
}

/// Pairs of bodies anew; those that there were before keep what is known of them.
void ContactList::find_pairs(const CellGrid& grid, Section& section) {
  Section::Lists &lists = section.lists, &old = section.old;
  std::swap(lists.body_pairs, old.body_pairs);
  std::swap(lists.listed, old.listed);
  std::swap(lists.looked, old.looked);
  std::swap(lists.pair_slots, old.pair_slots);
  lists.body_pairs.clear();
  for (std::size_t i = section.first; i < section.last; ++i) grid.append_pairs_of(i, lists.body_pairs);
  lists.listed.assign(lists.body_pairs.size(), {});
  lists.looked.assign(lists.body_pairs.size(), {});
  lists.pair_slots.assign(lists.body_pairs.size(), {});
  std::size_t was = 0;
  for (std::size_t p = 0; p < lists.body_pairs.size(); ++p) {
    while (was < old.body_pairs.size() && old.body_pairs[was] < lists.body_pairs[p]) ++was;
    if (was == old.body_pairs.size() || old.body_pairs[was] != lists.body_pairs[p]) continue;
    lists.listed[p] = old.listed[was];
    lists.looked[p] = old.looked[was];
    lists.pair_slots[p] = old.pair_slots[was];
  }
  section.changed = true;
}

/// Pairs whose bodies may come nearer to each other than their candidates know, before they are looked over
/// again.
/// @param all  also pairs neither of whose bodies has moved
void ContactList::list_pairs(const Bodies& bodies, bool all, Section& section) {
  Section::Lists& lists = section.lists;
  Reaching of_i, of_j;
  for (std::size_t p = 0; p < lists.body_pairs.size(); ++p) {
    const BodyPair& pair = lists.body_pairs[p];
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    if (!all && !moved_[i] && !moved_[j]) continue;
    const RelativePose pose(bodies, pair);
    const double shares = until_.spheres[i] - bodies.travel[i] + until_.spheres[j] - bodies.travel[j];
    if (lists.listed[p].holds(pose, shares + kRounding)) continue;
    lists.listed[p] = {pose, skins_.spheres};
    lists.looked[p] = {};
    const std::size_t begin = lists.pairs.count();
    if (in_reach(bodies, pair)) list_pair(bodies, pair, of_i, of_j, lists.pairs);
    lists.pairs.put_last_into(lists.pair_slots[p], begin);
    is_looked_[i] = 1;
    section.changed = true;
  }
  if (all || lists.pairs.is_loose(lists.pair_slots)) lists.pairs.close_up(lists.pair_slots);
}

bool ContactList::in_reach(const Bodies& bodies, const BodyPair& pair) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double dx = bodies.x[i] - bodies.x[j], dy = bodies.y[i] - bodies.y[j], dz = bodies.z[i] - bodies.z[j];
  const double bounds = bodies.reach[i] + bodies.reach[j] + skins_.spheres;
  return dx * dx + dy * dy + dz * dz < bounds * bounds;
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

/// Those of bodies that have not travelled far stay, unless a wall has moved (`all`).
void ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls, bool all, Section& section) {
  Section::Lists& lists = section.lists;
  lists.wall_slots.resize(section.last - section.first);
  for (std::size_t i = section.first; i < section.last; ++i) {
    if (!all && until_.spheres[i] <= until_.walls[i]) continue;
    until_.walls[i] = bodies.travel[i] + 0.5 * skins_.spheres;
    const std::size_t begin = lists.walls.count();
    list_walls_of(bodies, i, walls, lists.walls);
    lists.walls.put_last_into(lists.wall_slots[i - section.first], begin);
    is_looked_[i] = 1;
    section.changed = true;
  }
  if (all || lists.walls.is_loose(lists.wall_slots)) lists.walls.close_up(lists.wall_slots);
}

/// Sorted by sphere and wall.
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
