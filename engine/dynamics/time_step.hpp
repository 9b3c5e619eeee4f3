#pragma once

#include "engine/scene/scene.hpp"

namespace repose {

/// Rayleigh time of a sphere: T_R = π R √(ρ/G) / (0.163 ν + 0.8766)   [s]   (article eq. 9)
double rayleigh_time(double radius, const Material& material);

/// The same at the scene's stiffness [s].
double rayleigh_time(double radius, const Scene& scene);

/// Fastest that a particle falls on another: from the cylinder's top, with the speed of the pour [m/s].
double fall_speed(const SlumpTest& test);

/// Largest Δt √λ at which an oscillator ẍ = −λ x − 2 ζ √λ ẋ is stable as an integrator steps it [-]:
///   symplectic_euler  2 (√(1+ζ²) − ζ), from Δt² λ + 2 Δt c = 4 with c = 2 ζ √λ
///   velocity_verlet   2 (√(1+4ζ²) − 2ζ): the damper sees 3/2 v − 1/2 v of a step ago, Δt² λ + 4 Δt c = 4
///   explicit_euler    2 ζ, beyond which an oscillation grows, and 2 (ζ − √(ζ²−1)) for ζ > 1; at least
///                     kElasticEuler, where a Hertz collision with e = 1 gains a fifth of its energy
/// Where the roots of the characteristic polynomial reach the unit circle; checked by time_step_test.
double largest_stable_phase(Integrator integrator, double damping_ratio);
inline constexpr double kElasticEuler = 0.08;

/// The step that keeps a collision of this scene resolved, whatever the shape of its particles ("auto").
///
/// The stiffest contact that the scene makes is the impact, at the speed of a fall from the cylinder's top,
/// of a particle on one of its own spheres: δ = (15 m* v²/(16 Y* √R*))^{2/5}, k = 2 Y* √(R* δ), with
/// λ = n k Σ (1/m + r²/I_min) over both bodies, r the arm. Each sinks δ/2 into the other, with the share
/// δ/(2 d) of its surface, d the diameter of the sphere of its volume: of its N spheres n = 1 +
/// (N − 1) δ/d touch at once, of both bodies together. A contact's damping ratio is ζ = γ/2; kAutoContacts of
/// them on one body damp √kAutoContacts times as much. The step is kAutoStepShare of largest_stable_phase (of
/// plain Euler half as much, which leaves an oscillation half of its damping) over √λ, for the shape and size
/// where it is least: what a packing is stiffer and a motion livelier by is left to the share. README.md of
/// engine/stability has the margins that it leaves.
double automatic_time_step(const Scene& scene);
inline constexpr double kAutoStepShare = 0.4;
inline constexpr double kAutoContacts = 6.0;

/// Δt of a scene: numerics.time_step, or time_step_fraction × T_R(smallest sphere, scaled stiffness), or
/// automatic [s].
double time_step(const Scene& scene);

}  // namespace repose
