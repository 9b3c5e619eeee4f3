#pragma once

#include <limits>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose {

/// State of one body at an instant.
struct BodySnapshot {
  Vec3 position = Vec3::Zero();  ///< centre of mass [m]
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();          ///< [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< world frame [rad/s]
  double mass = 0.0;                     ///< [kg]
  double volume = 0.0;                   ///< of the body, not of the sum of its spheres [m³]
  int shape = 0;                         ///< index into Scene::particles.shapes
  double scale = 1.0;                    ///< of the shape
};

/// One sphere of a body, in the world.
struct SphereSnapshot {
  Vec3 centre = Vec3::Zero();  ///< [m]
  double radius = 0.0;         ///< [m]
  int body = 0;                ///< index into HeapSnapshot::bodies
};

/// A cylindrical shell of a snapshot, z upwards. The whole cylinder, or the half that faces +x or −x.
struct ShellSnapshot {
  double radius = 0.0;    ///< inner [m]
  double z_low = 0.0;     ///< [m]
  double z_high = 0.0;    ///< [m]
  double x_offset = 0.0;  ///< of its axis [m]
  enum class Part { whole, half_positive_x, half_negative_x } part = Part::whole;
};

/// Everything that measuring and writing need of a simulation at one instant: the bodies that have not left
/// the base, their spheres (grouped by body, in the order of the bodies) and the walls. The base's top is the
/// plane z = 0, centred at the origin; gravity acts along −z.
struct HeapSnapshot {
  double time = 0.0;  ///< simulated [s]
  std::vector<BodySnapshot> bodies;
  std::vector<SphereSnapshot> spheres;
  double base_radius = std::numeric_limits<double>::infinity();  ///< [m]
  double base_height = 0.0;                                      ///< [m]
  std::vector<ShellSnapshot> shells;  ///< what stands of the cylinder, may be empty
};

}  // namespace repose
