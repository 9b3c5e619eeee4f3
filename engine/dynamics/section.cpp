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

void Section::gather_near(std::span<const PlacedSphere> placed) {
  std::swap(near_pairs, old_near_pairs);
  near_pairs.gather(lists.pairs, placed, old_near_pairs);
  std::swap(near_walls, old_near_walls);
  near_walls.gather(lists.walls, placed, old_near_walls);
}

}  // namespace repose
