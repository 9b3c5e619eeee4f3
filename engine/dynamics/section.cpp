#include "engine/dynamics/section.hpp"

#include <utility>

namespace repose {

void Section::Lists::clear_pairs() {
  body_pairs.clear();
  listed.clear();
  looked.clear();
  pair_slots.clear();
}

void Section::Lists::swap_pairs(Lists& other) {
  body_pairs.swap(other.body_pairs);
  listed.swap(other.listed);
  looked.swap(other.looked);
  pair_slots.swap(other.pair_slots);
}

void Section::Lists::add_pair(const BodyPair& pair, const Tether& listed_then, const Tether& looked_then,
                              const CandidateSlot& slot) {
  body_pairs.push_back(pair);
  listed.push_back(listed_then);
  looked.push_back(looked_then);
  pair_slots.push_back(slot);
}

void Section::Lists::clear() {
  clear_pairs();
  pairs.clear();
  wall_slots.clear();
  walls.clear();
}

void Section::gather_near() {
  changed = false;
  std::swap(near_pairs, old_near_pairs);
  near_pairs.gather(lists.pairs, lists.pair_slots, lists.body_pairs, old_near_pairs);
  std::swap(near_walls, old_near_walls);
  for (std::size_t i = first + own_bodies_.size(); i < last; ++i)
    own_bodies_.push_back({static_cast<int>(i), 0});
  near_walls.gather(lists.walls, lists.wall_slots, own_bodies_, old_near_walls);
}

}  // namespace repose
