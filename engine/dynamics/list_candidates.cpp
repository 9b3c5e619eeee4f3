// Levels 1 and 2 of ContactList: pairs of bodies and their candidates.

#include <algorithm>
#include <iterator>

#include "engine/dynamics/contact_list.hpp"

namespace repose {

namespace {

/// Part of skins.spheres that a body may travel before its pairs are looked over. A larger one looks them
/// over less often, a smaller one lists fewer of them anew. Figures in tools/bench/NOTES.md.
constexpr double kShare = 0.25;
/// Steps that a share lasts at least. Else a few bodies that fall have the lists of all looked over at every
/// sixth step of a slump with large steps.
constexpr double kLeastSteps = 10.0;

}  // namespace

void ContactList::list_candidates(const Bodies& bodies, std::span<const Wall> walls, Relist anew,
                                  Crew& crew) {
  ++updates_;
  if (anew.bodies) {
    flag_searched(bodies);
    const CellGrid grid(search_spheres(bodies), skins_.bodies);
    each_section(crew, [&](Section& section) { search(grid, section); });
    each_section(crew, [&](Section& section) { take_found(section); });
  }
  share_out_pairs(bodies);
  each_section(crew, [&](Section& section) {
    list_pairs(bodies, section);
    list_walls(bodies, walls, anew.walls, section);
  });
}

SearchSpheres ContactList::search_spheres(const Bodies& bodies) {
  const auto first = [n = bodies.count](const std::vector<double>& array) {
    return std::span(array.data(), n);
  };
  return {first(bodies.x), first(bodies.y), first(bodies.z), first(bodies.reach)};
}

/// Bodies that have used more than half of their share get a new one with those that have used all of it,
/// so that this comes in batches.
void ContactList::share_out_pairs(const Bodies& bodies) {
  const double share = kShare * skins_.spheres;
  ends_.resize(bodies.count);
  more_.resize(bodies.count, 0.0);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    double& until = until_.spheres[i];
    if (bodies.travel[i] > until - 0.5 * (share + more_[i])) {
      more_[i] = std::clamp(kLeastSteps * bodies.pace[i] - share, 0.0, 0.5 * skins_.bodies);
      until = bodies.travel[i] + share + more_[i];
    }
    ends_[i] = {bodies, i, until - bodies.travel[i]};
  }
}

/// The same on level 1. A body may travel half of the skin of bodies, so that two that were beyond it when
/// either was searched last have not met before one of them is searched again.
void ContactList::flag_searched(const Bodies& bodies) {
  const double share = 0.5 * skins_.bodies;
  is_searched_.resize(bodies.count);
  for (std::size_t i = 0; i < bodies.count; ++i) {
    is_searched_[i] = bodies.travel[i] > until_.bodies[i] - 0.5 * share;
    if (is_searched_[i]) until_.bodies[i] = bodies.travel[i] + share;
  }
}

/// Of two bodies that are both searched, the pair is found by the one of the greater number.
void ContactList::search(const CellGrid& grid, Section& section) const {
  section.found.clear();
  section.found_above.clear();
  for (std::size_t i = section.first; i < section.last; ++i) {
    if (is_searched_[i] == 0) continue;
    grid.append_pairs_of(i, is_searched_, section.found, section.found_above);
  }
  std::ranges::sort(section.found_above);
}

/// Pairs of a section that bodies of sections before it or its own have found, sorted.
std::vector<BodyPair> ContactList::found_for(const Section& section) const {
  const BodyPair begin{static_cast<int>(section.first), 0}, end{static_cast<int>(section.last), 0};
  std::vector<BodyPair> above, all;
  for (const Section& from : sections) {
    if (from.first >= section.last) break;
    const auto first = std::ranges::lower_bound(from.found_above, begin);
    above.insert(above.end(), first, std::lower_bound(first, from.found_above.end(), end));
  }
  std::ranges::sort(above);
  all.reserve(section.found.size() + above.size());
  std::ranges::merge(section.found, above, std::back_inserter(all));
  return all;
}

/// Pairs of bodies that are searched become those that were found; what is known of a pair stays.
void ContactList::take_found(Section& section) {
  Section::Lists &lists = section.lists, &old = section.old;
  const std::vector<BodyPair> found = found_for(section);
  const auto is_searched = [this](const BodyPair& pair) {
    return is_searched_[static_cast<std::size_t>(pair.i)] != 0 ||
           is_searched_[static_cast<std::size_t>(pair.j)] != 0;
  };
  if (found.empty() && std::ranges::none_of(lists.body_pairs, is_searched)) return;
  lists.swap_pairs(old);
  lists.clear_pairs();
  auto next = found.begin();
  for (std::size_t was = 0; was < old.body_pairs.size(); ++was) {
    const BodyPair& pair = old.body_pairs[was];
    for (; next != found.end() && *next < pair; ++next) lists.add_pair(*next);
    const bool again = next != found.end() && *next == pair;
    if (again) ++next;
    if (again || !is_searched(pair))
      lists.add_pair(pair, old.listed[was], old.looked[was], old.pair_slots[was]);
    else
      section.changed |= old.pair_slots[was].near != 0;
  }
  for (; next != found.end(); ++next) lists.add_pair(*next);
}

/// Pairs whose bodies may come nearer to each other than their candidates know, before they are looked over
/// again, and those that have been found just now.
void ContactList::list_pairs(const Bodies& bodies, Section& section) {
  Section::Lists& lists = section.lists;
  Reaching of_i, of_j;
  for_each_let_go(lists.listed, lists.body_pairs, ends_, [&](std::size_t p) {
    const BodyPair& pair = lists.body_pairs[p];
    const double skin = skin_of(static_cast<std::size_t>(pair.i)) +
                        skin_of(static_cast<std::size_t>(pair.j)) - skins_.spheres;
    lists.listed[p] = {bodies, pair, skin};
    const std::size_t begin = lists.pairs.count();
    if (in_reach(bodies, pair, skin)) list_pair(bodies, pair, skin, of_i, of_j, lists.pairs);
    lists.pairs.put_last_into(lists.pair_slots[p], begin);
    section.changed |= lists.pair_slots[p].changed;
    lists.looked[p] = lists.pair_slots[p].count == 0 ? Tether::endless() : Tether();
  });
  if (lists.pairs.is_loose(lists.pair_slots)) lists.pairs.close_up(lists.pair_slots);
}

bool ContactList::in_reach(const Bodies& bodies, const BodyPair& pair, double skin) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const double dx = bodies.x[i] - bodies.x[j], dy = bodies.y[i] - bodies.y[j], dz = bodies.z[i] - bodies.z[j];
  const double bounds = bodies.reach[i] + bodies.reach[j] + skin;
  return dx * dx + dy * dy + dz * dz < bounds * bounds;
}

void ContactList::list_pair(const Bodies& bodies, const BodyPair& pair, double skin, Reaching& of_i,
                            Reaching& of_j, CandidateArrays& to) const {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const auto find = [&, origin = bodies.position(i)](std::size_t of, std::size_t into, Reaching& found) {
    found.find(local_, {bodies.shape[of], bodies.axes[of], bodies.position(of), first_sphere_[of]},
               bodies.position(into), bodies.reach[into] + skin, origin);
  };
  find(i, j, of_i);
  if (of_i.count == 0) return;
  find(j, i, of_j);
  for_each_near(of_i, of_j, skin,
                [&](std::size_t a, std::size_t b) { to.push(of_i.sphere[a], of_j.sphere[b]); });
}

/// Those of bodies that have not travelled far stay, unless a wall has moved (`all`).
void ContactList::list_walls(const Bodies& bodies, std::span<const Wall> walls, bool all, Section& section) {
  Section::Lists& lists = section.lists;
  lists.wall_slots.resize(section.last - section.first);
  for (std::size_t i = section.first; i < section.last; ++i) {
    if (!all && until_.spheres[i] <= until_.walls[i]) continue;
    until_.walls[i] = bodies.travel[i] + skin_of(i) - 0.5 * skins_.spheres;
    const std::size_t begin = lists.walls.count();
    list_walls_of(bodies, i, walls, lists.walls);
    CandidateSlot& slot = lists.wall_slots[i - section.first];
    lists.walls.put_last_into(slot, begin);
    section.changed |= all || slot.changed;
    is_looked_[i] = 1;
  }
  if (all || lists.walls.is_loose(lists.wall_slots)) lists.walls.close_up(lists.wall_slots);
}

/// Sorted by sphere and wall.
void ContactList::list_walls_of(const Bodies& bodies, std::size_t i, std::span<const Wall> walls,
                                CandidateArrays& to) const {
  const Vec3 position = bodies.position(i);
  const double skin = skin_of(i);
  bool near = false;
  for (const Wall& wall : walls) near |= wall.present && within_reach(wall, position, bodies.reach[i] + skin);
  if (!near) return;
  for (std::size_t s = first_sphere_[i]; s < first_sphere_[i + 1]; ++s) {
    const PlacedSphere sphere = placed_now(bodies, i, s);
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].present && within_reach(walls[w], Vec3(sphere.centre), sphere.radius + skin))
        to.push(static_cast<std::int32_t>(s), static_cast<std::int32_t>(w));
  }
}

}  // namespace repose
