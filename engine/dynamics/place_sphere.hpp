#pragma once

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/candidates.hpp"

namespace repose {

inline LocalSphere local_sphere(const Sphere& sphere, double scale) {
  return {{scale * sphere.centre.x(), scale * sphere.centre.y(), scale * sphere.centre.z()},
          scale * sphere.radius};
}

/// Places a sphere of a body: arm = Σ_k axes_k local_k, centre = x + arm. Written as rows of four, the last
/// of which is put right afterwards: number by number it took twice as long.
REPOSE_INLINE void place_sphere(const BodyAxes& axes, const LocalSphere& local, PlacedSphere& sphere) {
  using Four = stdx::fixed_size_simd<double, 4>;
  const auto row = [](const double* from) { return Four(from, stdx::vector_aligned); };
  const Four arm = row(axes.column[0]) * local.centre[0] + row(axes.column[1]) * local.centre[1] +
                   row(axes.column[2]) * local.centre[2];
  const std::int32_t body = sphere.body, number = sphere.sphere;
  arm.copy_to(sphere.arm, stdx::vector_aligned);
  sphere.body = body, sphere.sphere = number;
  (row(axes.position) + arm).copy_to(sphere.centre, stdx::vector_aligned);
  sphere.radius = local.radius;
}

}  // namespace repose
