#pragma once

#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"

namespace repose {

/// Places one sphere of a body: arm = scale Σ_k axes_k local_k, centre = x + arm, radius = scale r.
inline void place_sphere(const Bodies& bodies, const Sphere& local, PlacedSphere& sphere) {
  const auto i = static_cast<std::size_t>(sphere.body);
  const double scale = bodies.scale[i];
  const double lx = scale * local.centre.x(), ly = scale * local.centre.y(), lz = scale * local.centre.z();
  const BodyAxes& axes = bodies.axes[i];
  for (int k = 0; k < 3; ++k)
    sphere.arm[k] = axes.column[0][k] * lx + axes.column[1][k] * ly + axes.column[2][k] * lz;
  sphere.centre[0] = bodies.x[i] + sphere.arm[0];
  sphere.centre[1] = bodies.y[i] + sphere.arm[1];
  sphere.centre[2] = bodies.z[i] + sphere.arm[2];
  sphere.radius = scale * local.radius;
}

}  // namespace repose
