#pragma once

#include "engine/scene/scene.hpp"

namespace repose {

/// Rayleigh time of a sphere: T_R = π R √(ρ/G) / (0.163 ν + 0.8766)   [s]   (article eq. 9)
double rayleigh_time(double radius, const Material& material);

/// Scale at which a shape has the least volume that the scene can pour; 1 where there are no size classes.
double smallest_scale(const Particles& particles, const Clump& shape);

/// The radius of the smallest sphere that the scene can pour [m].
double smallest_sphere(const Particles& particles);

/// The radius of the sphere of the volume of the smallest particle that the scene can pour [m].
double equivalent_sphere(const Particles& particles);

/// Rayleigh time of such a sphere at the scene's stiffness [s].
double rayleigh_time(double radius, const Scene& scene);

/// Fastest that a particle falls on another: from the cylinder's top, with the speed of the pour [m/s].
double fall_speed(const SlumpTest& test);

/// The step that keeps a collision of this scene resolved, whatever the shape of its particles ("auto").
///
/// The stiffest contact that the scene makes is the impact, at the speed of a fall from the cylinder's top,
/// of a particle on one of its own spheres: δ = (15 m* v²/(16 Y* √R*))^{2/5}, k = 2 Y* √(R* δ). Leapfrog is
/// stable below 2/√λ with λ = k Σ (1/m + r²/I_min) over both bodies, r the arm; contact damping and further
/// contacts lower that, so the step is kAutoStepShare of it, for the shape and size where it is least.
double automatic_time_step(const Scene& scene);
inline constexpr double kAutoStepShare = 0.2;

/// Δt of a scene: numerics.time_step, or time_step_fraction × T_R(smallest sphere, scaled stiffness), or
/// automatic [s].
double time_step(const Scene& scene);

}  // namespace repose
