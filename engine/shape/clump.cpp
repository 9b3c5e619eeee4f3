#include "engine/shape/clump.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

int Clump::groups() const {
  constexpr double kGap = 0.1;
  std::vector<std::size_t> open(spheres.size());  // that no group has reached
  std::iota(open.begin(), open.end(), std::size_t{0});
  int count = 0;
  for (; !open.empty(); ++count) {
    std::vector<std::size_t> reached = {open.back()};
    open.pop_back();
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const Sphere& one = spheres[reached[k]];
      std::erase_if(open, [&](std::size_t index) {
        const Sphere& other = spheres[index];
        const double gap = (one.centre - other.centre).norm() - one.radius - other.radius;
        if (gap > kGap * std::min(one.radius, other.radius)) return false;
        reached.push_back(index);
        return true;
      });
    }
  }
  return count;
}

Clump sphere_clump(double radius) {
  const double cube = radius * radius * radius;
  return {.name = "sphere",
          .spheres = {{Vec3::Zero(), radius}},
          .volume = 4.0 / 3.0 * kPi * cube,
          .inertia = Vec3::Constant(8.0 / 15.0 * kPi * cube * radius * radius)};
}

}  // namespace repose
