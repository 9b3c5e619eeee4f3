#pragma once

#include "engine/scene/scene.hpp"

namespace repose {

/// Scale at which a shape has the least volume that the scene can pour; 1 where there are no size classes.
double smallest_scale(const Particles& particles, const Clump& shape);

/// The radius of the smallest sphere that the scene can pour [m].
double smallest_sphere(const Particles& particles);

/// The radius of the sphere of the volume of the smallest particle that the scene can pour [m].
double equivalent_sphere(const Particles& particles);

/// Largest and mean sizes that a scene pours.
struct LargestSizes {
  double mean_volume = 0.0;  ///< by number [m³]
  double diameter = 0.0;     ///< of the sphere of equal volume, largest [m]
  double span = 0.0;         ///< of the sphere around a particle, largest [m]
};

LargestSizes largest_sizes(const Particles& particles);

}  // namespace repose
