#include <algorithm>
#include <cmath>

#include "engine/measure/heap_bodies.hpp"
#include "engine/measure/heap_measurement.hpp"
#include "engine/measure/surface.hpp"

namespace repose {

namespace {

constexpr double kSlabLow = 0.1;
constexpr double kSlabHigh = 0.8;

/// Volume of a sphere between two heights, ∫ π (r² − t²) dt with t from the centre.
double segment_volume(const SphereSnapshot& sphere, double low, double high) {
  const double r = sphere.radius;
  const double a = std::clamp(low - sphere.centre.z(), -r, r);
  const double b = std::clamp(high - sphere.centre.z(), -r, r);
  return kPi * (r * r * (b - a) - (b * b * b - a * a * a) / 3.0);
}

/// Median height of the tops of the free surface; a body that floats or sticks out moves it little.
double column_height(const HeapSnapshot& column) {
  const std::vector<int> members = largest_cluster(column, bodies_over_base(column));
  std::vector<double> heights;
  for (const SurfaceTop& top : free_surface(column, members)) heights.push_back(top.z);
  if (heights.empty()) return 0.0;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

}  // namespace

double column_bulk_density(const HeapSnapshot& column, double cylinder_radius) {
  if (!is_finite(column) || !(cylinder_radius > 0.0)) return 0.0;
  const double height = column_height(column);
  if (!(height > 0.0)) return 0.0;
  const double low = kSlabLow * height;
  const double high = kSlabHigh * height;

  // Spheres of a clump overlap: their sum serves only to share the body's own mass between slab and rest.
  std::vector<double> inside(column.bodies.size(), 0.0);
  std::vector<double> whole(column.bodies.size(), 0.0);
  for (const SphereSnapshot& sphere : column.spheres) {
    const auto body = static_cast<std::size_t>(sphere.body);
    inside[body] += segment_volume(sphere, low, high);
    whole[body] += 4.0 / 3.0 * kPi * sphere.radius * sphere.radius * sphere.radius;
  }
  double mass = 0.0;
  for (std::size_t b = 0; b < inside.size(); ++b) {
    if (whole[b] > 0.0) mass += column.bodies[b].mass * inside[b] / whole[b];
  }
  return mass / (kPi * cylinder_radius * cylinder_radius * (high - low));
}

}  // namespace repose
