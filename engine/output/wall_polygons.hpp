#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// Walls as polygons for pictures; the simulation itself knows exact shapes only.
struct WallPolygons {
  std::vector<Vec3> points;                         ///< [m]
  std::vector<std::int32_t> wall;                   ///< of each point: 0 the base, 1 … the shells
  std::vector<std::vector<std::int32_t>> polygons;  ///< point numbers
};

/// The base's top and side (an unbounded base: a square that reaches a tenth beyond every body), and each
/// shell or half.
WallPolygons wall_polygons(const HeapSnapshot& heap);

}  // namespace repose
