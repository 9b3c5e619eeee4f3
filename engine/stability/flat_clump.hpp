#pragma once

#include "engine/scene/scene.hpp"
#include "engine/stability/probe.hpp"

namespace repose {

/// A flat clump on a plate: n × n equal spheres in a plane, of the radius of the scene's smallest sphere, as
/// far apart as the width of the sphere of its smallest particle's volume allows; with that volume, and the
/// moments of a plate of that width. n² is the number of spheres of the scene's largest clump, at least 3
/// × 3. All touch the plate at once: N springs on one mass.
struct FlatClump {
  Clump clump;
  int contacts = 0;       ///< n²
  double mass = 0.0;      ///< [kg]
  double height = 0.0;    ///< that its centre falls by until it lies [m]
  double speed = 0.0;     ///< sideways, at the beginning [m/s]
  double duration = 0.0;  ///< of the experiment [s]
};
FlatClump flat_clump(const Scene& scene);

/// The sound motion: symplectic Euler at a fifth of the automatic step.
struct FlatMotion {
  double stiffness_time = 0.0;  ///< least √(m/ΣK) of the clump, by the bound of MotionWatch [s]
  double deepest = 0.0;         ///< largest overlap over the radius [-]
};
FlatMotion flat_motion(const Scene& scene);

/// The clump falls on the plate with one side a little lower, slides, rocks and comes to rest, with the
/// scene's contact of particle and wall. The energy error is over what it brings, ½ m v² + m g h; overlaps
/// are compared with those of the sound motion.
/// @param sound  of this rolling model
Experiment flat_clump_experiment(const Scene& scene, const FlatMotion& sound, const Tolerance& tolerance,
                                 const std::atomic<bool>* stop);

}  // namespace repose
