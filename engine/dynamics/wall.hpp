#pragma once

#include <limits>

#include "engine/base/vec3.hpp"

namespace repose {

/// The nearest point of a wall, seen from a point in space.
struct WallDistance {
  Vec3 normal = Vec3::UnitZ();  ///< unit, from the wall to the point
  double distance =
      std::numeric_limits<double>::infinity();  ///< [m]; negative: the point is behind the surface
};

/// A wall as an exact shape. A plain tagged struct, so that walls lie in one array and nothing is virtual.
struct Wall {
  enum class Kind {
    base,             ///< solid upright cylinder with its top at z = 0; infinite radius: the plane z = 0
    closed_shell,     ///< cylinder seen from inside only: nothing can be outside of it
    open_shell,       ///< thin cylinder between z_low and z_high, both sides and rims
    half_shell_plus,  ///< the half x ≥ x_offset of an open shell, with its edges
    half_shell_minus  ///< the half x ≤ x_offset
  };
  Kind kind = Kind::base;
  double radius = std::numeric_limits<double>::infinity();  ///< [m]
  double z_low = 0.0;                                       ///< shells [m]; base: −height
  double z_high = 0.0;                                      ///< shells [m]
  double x_offset = 0.0;                                    ///< of the shell's axis [m]
  Vec3 velocity = Vec3::Zero();                             ///< [m/s]
  bool present = true;

  /// Moves the wall by one step.
  void advance(double dt) {
    x_offset += dt * velocity.x();
    z_low += dt * velocity.z();
    z_high += dt * velocity.z();
  }
};

/// Exact distance of a point to a wall: the nearest of its surface, its rim and its edges.
WallDistance distance_to(const Wall& wall, const Vec3& point);

/// Whether a point is nearer to a wall than `reach`, without a root where that is easily told. A closed shell
/// goes on for ever above its rim here: what falls into it is near it before it can touch it.
bool within_reach(const Wall& wall, const Vec3& point, double reach);

}  // namespace repose
