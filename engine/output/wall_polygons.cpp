#include "engine/output/wall_polygons.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

namespace {

constexpr int kSegments = 96;  ///< of a whole circle

/// A band between z_low and z_high along an arc, as quadrilaterals; closed for a whole circle.
void add_band(WallPolygons& walls, std::int32_t wall, const ShellSnapshot& shell, double from, double angle,
              int segments) {
  const auto first = static_cast<std::int32_t>(walls.points.size());
  for (int k = 0; k <= segments; ++k) {
    const double a = from + angle * k / segments;
    const double x = shell.x_offset + shell.radius * std::cos(a), y = shell.radius * std::sin(a);
    walls.points.emplace_back(x, y, shell.z_low);
    walls.points.emplace_back(x, y, shell.z_high);
    walls.wall.insert(walls.wall.end(), 2, wall);
  }
  for (std::int32_t k = first; k < first + 2 * segments; k += 2)
    walls.polygons.push_back({k, k + 2, k + 3, k + 1});
}

void add_base(WallPolygons& walls, const HeapSnapshot& heap) {
  std::vector<std::int32_t> top;
  if (std::isinf(heap.base_radius)) {
    double reach = 0.05;
    for (const SphereSnapshot& sphere : heap.spheres)
      reach = std::max({reach, std::abs(sphere.centre.x()), std::abs(sphere.centre.y())});
    reach *= 1.1;
    walls.points = {{-reach, -reach, 0.0}, {reach, -reach, 0.0}, {reach, reach, 0.0}, {-reach, reach, 0.0}};
    walls.wall.assign(4, 0);
    walls.polygons.push_back({0, 1, 2, 3});
    return;
  }
  for (int k = 0; k < kSegments; ++k) {
    const double a = 2.0 * kPi * k / kSegments;
    top.push_back(static_cast<std::int32_t>(walls.points.size()));
    walls.points.emplace_back(heap.base_radius * std::cos(a), heap.base_radius * std::sin(a), 0.0);
    walls.wall.push_back(0);
  }
  walls.polygons.push_back(top);
  add_band(walls, 0, {heap.base_radius, -heap.base_height, 0.0, 0.0, ShellSnapshot::Part::whole}, 0.0,
           2.0 * kPi, kSegments);
}

}  // namespace

WallPolygons wall_polygons(const HeapSnapshot& heap) {
  WallPolygons walls;
  add_base(walls, heap);
  std::int32_t wall = 0;
  for (const ShellSnapshot& shell : heap.shells) {
    const bool whole = shell.part == ShellSnapshot::Part::whole;
    const double from = shell.part == ShellSnapshot::Part::half_negative_x ? 0.5 * kPi : -0.5 * kPi;
    add_band(walls, ++wall, shell, from, whole ? 2.0 * kPi : kPi, whole ? kSegments : kSegments / 2);
  }
  return walls;
}

}  // namespace repose
