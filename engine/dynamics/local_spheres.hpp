#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/shape/clump.hpp"

namespace repose {

/// A sphere of a shape of scale 1, in the frame of its body, as rows of four that place it
/// (place_sphere.hpp).
struct alignas(64) LocalSphere {
  double centre[3] = {};  ///< [m]
  double radius = 0.0;    ///< [m]
  double ones_and_radius[4] = {1.0, 1.0, 1.0, 0.0};
};

/// The spheres of all shapes, sphere by sphere and as columns.
struct LocalSpheres {
  static constexpr std::int32_t kLine = 8;  ///< doubles of a LocalSphere

  explicit LocalSpheres(std::span<const Clump> shapes);

  std::vector<LocalSphere> rows;
  std::vector<std::int32_t> first_row;  ///< of each shape, and one past the last
  /// The same, each shape padded to whole vectors with spheres that are far from all others.
  std::vector<double> x, y, z, radius;
  std::vector<std::size_t> first_column;  ///< of each shape, and one past the last
};

}  // namespace repose
