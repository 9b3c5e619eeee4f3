#pragma once

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/candidates.hpp"
#include "engine/dynamics/local_spheres.hpp"

namespace repose {

/// Places a sphere of a body: centre = x + Σ_k scale axes_k local_k, radius = scale × local radius. One row
/// of four: the last lane of the columns is 0 and that of the position is the scale, which the last row
/// brings to the radius. Number by number it took twice as long.
REPOSE_INLINE void place_sphere(const BodyAxes& axes, const LocalSphere& local, PlacedSphere& sphere) {
  using Four = stdx::fixed_size_simd<double, 4>;
  const auto row = [](const double* from) { return Four(from, stdx::vector_aligned); };
  const Four placed = row(axes.column[0]) * local.centre[0] + row(axes.column[1]) * local.centre[1] +
                      row(axes.column[2]) * local.centre[2] + row(axes.position);
  (placed * row(local.ones_and_radius)).copy_to(sphere.centre, stdx::vector_aligned);
}

}  // namespace repose
