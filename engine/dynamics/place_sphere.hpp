#pragma once

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/candidates.hpp"

namespace repose {

/// Places a sphere of a body: arm = Σ_k axes_k scale local_k, centre = x + arm. Written as rows of four, the
/// last of which is put right afterwards: number by number it took twice as long.
REPOSE_INLINE void place_sphere(const BodyAxes& axes, const LocalSphere& local, PlacedSphere& sphere) {
  const double scale = axes.position[3];
  using Four = stdx::fixed_size_simd<double, 4>;
  const auto row = [](const double* from) { return Four(from, stdx::vector_aligned); };
  const Four arm = row(axes.column[0]) * (scale * local.centre[0]) +
                   row(axes.column[1]) * (scale * local.centre[1]) +
                   row(axes.column[2]) * (scale * local.centre[2]);
  const std::int32_t body = sphere.body, number = sphere.local;
  arm.copy_to(sphere.arm, stdx::vector_aligned);
  sphere.body = body, sphere.local = number;
  (row(axes.position) + arm).copy_to(sphere.centre, stdx::vector_aligned);
  sphere.radius = scale * local.radius;
}

}  // namespace repose
