#include "engine/shape/clump.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

double Clump::bounding_radius() const {
  double radius = 0.0;
  for (const Sphere& sphere : spheres) radius = std::max(radius, sphere.centre.norm() + sphere.radius);
  return radius;
}

double Clump::equivalent_diameter() const { return std::cbrt(6.0 * volume / kPi); }

double Clump::smallest_radius() const {
  double radius = spheres.empty() ? 0.0 : spheres.front().radius;
  for (const Sphere& sphere : spheres) radius = std::min(radius, sphere.radius);
  return radius;
}

Clump sphere_clump(double radius) {
  const double cube = radius * radius * radius;
  return {.name = "sphere",
          .spheres = {{Vec3::Zero(), radius}},
          .volume = 4.0 / 3.0 * kPi * cube,
          .inertia = Vec3::Constant(8.0 / 15.0 * kPi * cube * radius * radius)};
}

}  // namespace repose
