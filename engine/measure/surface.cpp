#include "engine/measure/surface.hpp"

#include <algorithm>
#include <limits>

#include "engine/measure/heap_bodies.hpp"
#include "engine/measure/point_grid.hpp"

namespace repose {

namespace {

constexpr double kShadow = 0.7;  // of the mean diameter of two bodies

/// Highest point of every body, at the body's index.
std::vector<SurfaceTop> body_tops(const HeapSnapshot& heap) {
  std::vector<SurfaceTop> tops(heap.bodies.size());
  for (SurfaceTop& top : tops) top.z = -std::numeric_limits<double>::infinity();
  for (const SphereSnapshot& sphere : heap.spheres) {
    SurfaceTop& top = tops[static_cast<std::size_t>(sphere.body)];
    const double z = sphere.centre.z() + sphere.radius;
    if (z > top.z) top = {sphere.centre.x(), sphere.centre.y(), z, 0.0};
  }
  return tops;
}

}  // namespace

std::vector<SurfaceTop> free_surface(const HeapSnapshot& heap, const std::vector<int>& members) {
  if (members.empty()) return {};
  const std::vector<SurfaceTop> all = body_tops(heap);
  std::vector<SurfaceTop> tops;
  std::vector<Vec3> plan;
  std::vector<double> diameters;
  for (const int b : members) {
    tops.push_back(all[static_cast<std::size_t>(b)]);
    tops.back().diameter = equivalent_diameter(heap.bodies[static_cast<std::size_t>(b)]);
    plan.emplace_back(tops.back().x, tops.back().y, 0.0);
    diameters.push_back(tops.back().diameter);
  }
  std::nth_element(diameters.begin(), diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 2),
                   diameters.end());
  const PointGrid grid(plan, kShadow * diameters[diameters.size() / 2]);
  std::vector<char> shadowed(tops.size(), 0);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    grid.each_within(plan[i], kShadow * tops[i].diameter, [&](std::size_t j, double squared) {
      const double reach = 0.5 * kShadow * (tops[i].diameter + tops[j].diameter);
      if (tops[j].diameter > tops[i].diameter || squared > reach * reach) return;
      if (tops[j].z < tops[i].z) shadowed[j] = 1;
      if (tops[i].z < tops[j].z) shadowed[i] = 1;
    });
  }
  std::vector<SurfaceTop> surface;
  for (std::size_t i = 0; i < tops.size(); ++i) {
    if (!shadowed[i]) surface.push_back(tops[i]);
  }
  return surface;
}

}  // namespace repose
