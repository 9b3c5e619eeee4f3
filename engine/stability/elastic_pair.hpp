#pragma once

#include "engine/scene/scene.hpp"
#include "engine/stability/probe.hpp"

namespace repose {

/// Two equal spheres of the volume of the scene's smallest particle that meet head on, e = 1, no friction, at
/// the speed of a fall from the cylinder's top. One collision has a closed form:
///   δ_max = (15 m* v²/(16 Y* √R*))^{2/5},   t_c = 2.868 (m*²/(R* Y*² v))^{1/5},
///   k_max = 2 Y* √(R* δ_max),   ω = √(k_max/m*)
/// Source: Johnson, Contact Mechanics 1985, section 11.4.
struct ElasticPair {
  double radius = 0.0;          ///< of either sphere [m]
  double speed = 0.0;           ///< of approach [m/s]
  double m_eff = 0.0;           ///< m* [kg]
  double deepest = 0.0;         ///< δ_max [m]
  double contact_time = 0.0;    ///< t_c [s]
  double stiffness_time = 0.0;  ///< √(m/ΣK) of a sphere at δ_max, both of which give way: 1/ω [s]
};
ElasticPair elastic_pair(const Scene& scene);

/// Collisions that begin at kPhases evenly spread parts of a step, because it matters where in a step a
/// contact begins. The energy error is the worst over them of what the rebound has gained or lost, over ½ m*
/// v².
Experiment elastic_pair_experiment(const Scene& scene, const Tolerance& tolerance);
inline constexpr int kPhases = 16;

}  // namespace repose
