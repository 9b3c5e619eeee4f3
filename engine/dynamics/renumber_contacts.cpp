// What ContactList holds of bodies that go, and of those whose numbers change for it.

#include <algorithm>

#include "engine/dynamics/contact_list.hpp"

namespace repose {

/// Where the bodies and spheres of before are now; kDropped: gone.
struct ContactList::Renumbering {
  static constexpr std::int32_t kDropped = -1;
  std::span<const int> body;
  std::vector<std::size_t> old_first;   ///< sphere of each body, and one past the last
  std::vector<std::int32_t> new_first;  ///< of each body
  std::vector<std::int32_t> place_of;   ///< of each sphere of before

  [[nodiscard]] bool stays(std::size_t of_body) const { return body[of_body] >= 0; }
  [[nodiscard]] std::int32_t moved(std::int32_t sphere, std::size_t of_body) const {
    return sphere - static_cast<std::int32_t>(old_first[of_body]) + new_first[of_body];
  }
};

/// Sections before the first body that goes stay as they are: their pairs are with bodies of smaller numbers.
void ContactList::renumber(const Bodies& bodies, std::span<const int> new_index, Crew& crew) {
  ++changes_;
  const auto dropped = static_cast<std::size_t>(
      std::ranges::find_if(new_index, [](int index) { return index < 0; }) - new_index.begin());
  const Renumbering to = move_spheres(new_index);
  const std::size_t first_section = dropped / section_bodies_;
  move_lists(to, first_section);
  while (!sections.empty() && sections.back().first >= bodies.count) sections.pop_back();
  if (!sections.empty()) sections.back().last = bodies.count;
  more_.resize(new_index.size(), 0.0);
  for (auto* array : {&until_.bodies, &until_.spheres, &until_.walls, &until_.near, &more_})
    for (std::size_t i = 0; i < new_index.size(); ++i)
      if (new_index[i] >= 0) (*array)[static_cast<std::size_t>(new_index[i])] = (*array)[i];
  until_.resize(bodies.count, bodies.padded());
  each_section(crew, [&](Section& section) {
    if (section.first >= first_section * section_bodies_) section.gather_near();
    flag_needed(section);
  });
  find_places(bodies, crew);
  move_placed(to);
}

/// Spheres of the bodies that stay are numbered anew.
ContactList::Renumbering ContactList::move_spheres(std::span<const int> new_index) {
  Renumbering renumbering{new_index, std::move(first_sphere_), {}, std::move(place_of_)};
  const std::vector<std::size_t>& old_first = renumbering.old_first;
  first_sphere_.assign(1, 1);
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    const bool stays = new_index[i] >= 0;
    const std::size_t first = first_sphere_.back();
    renumbering.new_first.push_back(stays ? static_cast<std::int32_t>(first) : Renumbering::kDropped);
    if (stays) first_sphere_.push_back(first + old_first[i + 1] - old_first[i]);
  }
  place_of_.assign(first_sphere_.back(), 0);
  is_needed_.assign(first_sphere_.back(), 0);
  return renumbering;
}

/// Where spheres are is of the last step, and so what their bodies have moved to since does not give it. A
/// sphere that is needed was needed before, and its place is not behind the one that it had: one pass.
void ContactList::move_placed(const Renumbering& from) {
  std::size_t old = 0;  // body of before
  for (const Section& section : sections) {
    for (const Section::Needed& needed : section.needed) {
      while (from.body[old] != needed.body) ++old;
      const auto sphere = static_cast<std::size_t>(needed.sphere);
      const std::size_t was =
          from.old_first[old] + sphere - first_sphere_[static_cast<std::size_t>(needed.body)];
      placed[static_cast<std::size_t>(place_of_[sphere])] =
          placed[static_cast<std::size_t>(from.place_of[was])];
    }
  }
  placed.resize(first_sphere_.back());
}

/// The order of bodies stays, and with it that of their candidates and contacts.
void ContactList::move_lists(const Renumbering& to, std::size_t first_section) {
  for (std::size_t s = first_section; s < sections.size(); ++s) {
    Section& section = sections[s];
    std::swap(section.lists, section.old);
    section.lists.clear();
    std::swap(section.near_pairs, section.old_near_pairs);
    section.near_pairs.clear();
    std::swap(section.near_walls, section.old_near_walls);
    section.near_walls.clear();
  }
  for (std::size_t s = first_section; s < sections.size(); ++s) {
    move_candidates(to, sections[s]);
    move_contacts(to, sections[s]);
  }
}

void ContactList::move_candidates(const Renumbering& to, const Section& from) {
  const auto body = [&](int old) { return to.body[static_cast<std::size_t>(old)]; };
  for (std::size_t p = 0; p < from.old.body_pairs.size(); ++p) {
    const auto [i, j] = from.old.body_pairs[p];
    if (body(i) < 0 || body(j) < 0) continue;
    Section::Lists& lists = section_of(static_cast<std::size_t>(body(i))).lists;
    const CandidateSlot& slot = from.old.pair_slots[p];
    const std::size_t begin = lists.pairs.count();
    for (std::size_t c = slot.begin; c < slot.begin + slot.count; ++c)
      lists.pairs.push(to.moved(from.old.pairs.a[c], static_cast<std::size_t>(i)),
                       to.moved(from.old.pairs.b[c], static_cast<std::size_t>(j)), from.old.pairs.near[c]);
    lists.add_pair({body(i), body(j)}, from.old.listed[p], from.old.looked[p], lists.pairs.slot_from(begin));
  }
  // Bodies that have been added since the last listing have no candidates yet, and are behind all others.
  for (std::size_t k = 0; k < from.old.wall_slots.size(); ++k) {
    const std::size_t i = from.first + k;
    if (!to.stays(i)) continue;
    Section::Lists& lists = section_of(static_cast<std::size_t>(to.body[i])).lists;
    const CandidateSlot& slot = from.old.wall_slots[k];
    const std::size_t begin = lists.walls.count();
    for (std::size_t c = slot.begin; c < slot.begin + slot.count; ++c)
      lists.walls.push(to.moved(from.old.walls.a[c], i), from.old.walls.b[c], from.old.walls.near[c]);
    lists.wall_slots.push_back(lists.walls.slot_from(begin));
  }
}

/// Near candidates that do not touch have nothing to keep.
void ContactList::move_contacts(const Renumbering& to, const Section& from) {
  from.old_near_pairs.for_each_touched([&](const NearList& old, std::size_t k) {
    const std::size_t i = old.first_body(k), j = old.second_body(k);
    if (!to.stays(i) || !to.stays(j)) return;
    section_of(static_cast<std::size_t>(to.body[i]))
        .near_pairs.append(to.moved(old.sphere_a[k], i), to.moved(old.sphere_b[k], j),
                           {to.body[i], to.body[j]}, old, k);
  });
  from.old_near_walls.for_each_touched([&](const NearList& old, std::size_t k) {
    const std::size_t i = old.first_body(k);
    if (!to.stays(i)) return;
    section_of(static_cast<std::size_t>(to.body[i]))
        .near_walls.append(to.moved(old.sphere_a[k], i), old.sphere_b[k], {to.body[i], 0}, old, k);
  });
}

}  // namespace repose
