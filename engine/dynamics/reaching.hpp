#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/local_spheres.hpp"

namespace repose {

/// Those spheres of a body that come near a point, such as the middle of another body.
struct Reaching {
  /// The body that they belong to.
  struct Of {
    int shape = 0;
    const BodyAxes& axes;
    Vec3 position;                 ///< [m]
    std::size_t first_sphere = 0;  ///< number of its first sphere
  };

  std::vector<std::int32_t> sphere;     ///< its number, ascending
  std::vector<double> x, y, z, radius;  ///< padded to whole vectors with spheres that are far from all [m]
  std::size_t count = 0;

  /// Finds the spheres of a body whose surface is nearer than `reach` to a point.
  /// @param origin  of x, y, z, world [m]
  void find(const LocalSpheres& local, const Of& body, const Vec3& point, double reach, const Vec3& origin);

 private:
  void make_room(std::size_t spheres);
  void place(const BodyAxes& axes, const Vec3& shift);
};

/// visit(a, b) for all a of `of_i` and b of `of_j`, a ascending, then b, whose surfaces are nearer to each
/// other than `gap`; both found with the same origin.
template <class Visit>
void for_each_near(const Reaching& of_i, const Reaching& of_j, double gap, Visit visit) {
  for (std::size_t a = 0; a < of_i.count; ++a) {
    const SimdReal x = of_i.x[a], y = of_i.y[a], z = of_i.z[a], r = of_i.radius[a] + gap;
    for (std::size_t b = 0; b < of_j.count; b += kSimdWidth) {
      const SimdReal dx = x - load(of_j.x, b), dy = y - load(of_j.y, b), dz = z - load(of_j.z, b);
      const SimdReal reach = r + load(of_j.radius, b);
      for (unsigned near = less_bits(dx * dx + dy * dy + dz * dz, reach * reach); near != 0; near &= near - 1)
        visit(a, b + static_cast<std::size_t>(std::countr_zero(near)));
    }
  }
}

}  // namespace repose
