#include "engine/measure/heap_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/measure/point_grid.hpp"

namespace repose {

namespace {

constexpr double kLink = 0.75;  // of the sum of two diameters

/// Union-find over 0 … n−1 with path halving.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const std::size_t a = root(i);
    const std::size_t b = root(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

double equivalent_diameter(const BodySnapshot& body) { return std::cbrt(6.0 * body.volume / kPi); }

bool is_finite(const HeapSnapshot& heap) {
  const auto good_body = [](const BodySnapshot& b) {
    return b.position.allFinite() && std::isfinite(b.mass) && std::isfinite(b.volume);
  };
  const auto good_sphere = [](const SphereSnapshot& s) {
    return s.centre.allFinite() && std::isfinite(s.radius);
  };
  return std::all_of(heap.bodies.begin(), heap.bodies.end(), good_body) &&
         std::all_of(heap.spheres.begin(), heap.spheres.end(), good_sphere);
}

std::vector<int> bodies_over_base(const HeapSnapshot& heap) {
  std::vector<int> over;
  for (std::size_t b = 0; b < heap.bodies.size(); ++b) {
    const Vec3& c = heap.bodies[b].position;
    if (c.z() > 0.0 && std::hypot(c.x(), c.y()) <= heap.base_radius) over.push_back(static_cast<int>(b));
  }
  return over;
}

std::vector<int> largest_cluster(const HeapSnapshot& heap, const std::vector<int>& candidates) {
  if (candidates.empty()) return {};
  std::vector<Vec3> centres;
  std::vector<double> diameters;
  for (const int b : candidates) {
    const BodySnapshot& body = heap.bodies[static_cast<std::size_t>(b)];
    centres.push_back(body.position);
    diameters.push_back(equivalent_diameter(body));
  }
  std::vector<double> sorted = diameters;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const PointGrid grid(centres, 2.0 * kLink * sorted[sorted.size() / 2]);
  Groups groups(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    // Each pair is found from its larger body, whose reach covers the pair's.
    grid.each_within(centres[i], 2.0 * kLink * diameters[i], [&](std::size_t j, double squared) {
      const double reach = kLink * (diameters[i] + diameters[j]);
      if (diameters[j] <= diameters[i] && squared <= reach * reach) groups.join(i, j);
    });
  }
  std::vector<double> volume(candidates.size(), 0.0);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    volume[groups.root(i)] += heap.bodies[static_cast<std::size_t>(candidates[i])].volume;
  }
  const auto largest =
      static_cast<std::size_t>(std::max_element(volume.begin(), volume.end()) - volume.begin());
  std::vector<int> members;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (groups.root(i) == largest) members.push_back(candidates[i]);
  }
  return members;
}

}  // namespace repose
