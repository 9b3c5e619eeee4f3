#include "engine/shape/medial_balls.hpp"

#include <algorithm>
#include <limits>

namespace repose {

namespace {

Sphere shrunk(const SurfaceSamples& samples, std::size_t at, double largest, double tolerance) {
  const Vec3& p = samples.points[at];
  const Vec3 inward = -samples.normals[at];
  double radius = largest;
  for (int round = 0; round < 40; ++round) {
    const Vec3 centre = p + radius * inward;
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t found = at;
    for (std::size_t j = 0; j < samples.points.size(); ++j) {
      const double square = (samples.points[j] - centre).squaredNorm();
      if (j != at && square < nearest) {
        nearest = square;
        found = j;
      }
    }
    const double free = radius - tolerance;
    if (found == at || free <= 0.0 || nearest >= free * free) break;
    // The ball through p and q with its centre on the normal: r = |q−p|² / (2 (q−p)·n).
    const Vec3 chord = samples.points[found] - p;
    const double along = chord.dot(inward);
    if (along <= 0.0) break;
    const double next = std::max(chord.squaredNorm() / (2.0 * along), tolerance);
    if (next >= radius) break;
    radius = next;
  }
  return {p + radius * inward, radius};
}

}  // namespace

std::vector<Sphere> medial_balls(const SurfaceSamples& samples, double tolerance) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  for (const Vec3& point : samples.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double largest = 0.5 * (high - low).norm();
  std::vector<Sphere> balls;
  balls.reserve(samples.points.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i)
    balls.push_back(shrunk(samples, i, largest, tolerance));
  return balls;
}

}  // namespace repose
