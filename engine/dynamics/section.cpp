#include "engine/dynamics/section.hpp"

#include <utility>

namespace repose {

void Section::Lists::clear() {
  body_pairs.clear();
  pair_begin.assign(1, 0);
  wall_begin.assign(1, 0);
  pairs.clear();
  walls.clear();
}

void Section::gather_near() {
  std::swap(near_pairs, old_near_pairs);
  near_pairs.gather(lists.pairs, lists.pair_begin, lists.body_pairs, old_near_pairs);
  std::swap(near_walls, old_near_walls);
  for (std::size_t i = first + own_bodies_.size(); i < last; ++i)
    own_bodies_.push_back({static_cast<int>(i), 0});
  near_walls.gather(lists.walls, lists.wall_begin, own_bodies_, old_near_walls);
}

}  // namespace repose
