#pragma once

#include "engine/base/model.hpp"
#include "engine/dynamics/bodies.hpp"

namespace repose {

/// What a step of the motion is made of.
struct MotionStep {
  double dt = 0.0;  ///< Δt [s]
  /// type_a: Bodies::load holds Σ μr |F_n| R_i to resist rolling with; type_a_relative:
  /// BodyMotion::inertia_term follows the number of contacts.
  RollingModel rolling = RollingModel::type_a;
  Integrator integrator = Integrator::symplectic_euler;
  RollingTorque rolling_torque = RollingTorque::limited;
  bool booked = true;  ///< whether the energy is returned; zero otherwise
};

/// Moves all bodies by one step Δt under gravity and what contacts have added up in Bodies::load. With a =
/// F/m + g, F of the positions x and of the velocities in Bodies::motion:
///
///   symplectic_euler  v ← v + Δt a, x ← x + Δt v. The same as leapfrog with v at half steps: second order
///   where
///                     F depends on positions alone. Contacts see the v of half a step ago, which makes
///                     damping first order.
///   velocity_verlet   the same, but damping is given v + Δt/2 a with the a of the last step (Bodies::lead),
///   the
///                     velocity at the time of the positions, and is second order as well (Groot & Warren
///                     1997, λ = 1/2). Codes that call the force with the half-step v inside a velocity
///                     Verlet step, as LAMMPS and LIGGGHTS do, move as symplectic_euler.
///   explicit_euler    x ← x + Δt v, v ← v + Δt a: first order, and it gives energy to every oscillation.
///
/// Angular momentum L and orientation are stepped in the same order, L as v and the orientation as x.
///
/// Rotation keeps the angular momentum L in the world frame, L ← L + Δt T, so that without torque L is
/// constant to the last bit. The free rotation that follows is split into rotations about the body's
/// principal axes 1, 2, 3, 2, 1 over Δt/2, Δt/2, Δt, Δt/2, Δt/2 (Dullweber, Leimkuhler & McLachlan 1997).
/// Each is the exact flow of one term l_k²/(2 I_k) of the kinetic energy: l_k is constant, the body turns by
/// φ = h l_k/I_k, and l turns by −φ as the body sees it. The splitting is symmetric, hence second order, and
/// symplectic, hence without drift in energy. The turn is done with the Cayley map q ← q (1, φ/2 e_k), which
/// is a rotation for any φ and differs from φ by φ³/12, within the order of the splitting.
///
/// type_a rolling resistance (article eq. 2) is a torque of size M = Σ μr |F_n| R_i against ω. Its impulse λ
/// = Δt M never does more than take the rotation away: L becomes zero where |L| ≤ λ, and elsewhere λ stays
/// below |ω|/(ω̂ᵀ I⁻¹ ω̂), where the kinetic energy is least. Without this limit the sign of ω flips at every
/// step of a heap at rest, which then keeps moving; RollingTorque::unlimited takes it away.
/// Bodies::travel grows by what the fastest point of each body may have moved: Δt |v| and, for the turns, at
/// most swing times the sum of their angles (Cayley's 2 atan(φ/2) ≤ φ).
/// @param first, last  the bodies to move: first is a multiple of Bodies::kPadding, and last, too, unless it
/// is bodies.count
/// @return the energy that rolling resistance of type_a took from them [J]
double integrate(Bodies& bodies, const MotionStep& step, std::size_t first, std::size_t last);
/// All bodies.
inline double integrate(Bodies& bodies, const MotionStep& step) {
  return integrate(bodies, step, 0, bodies.count);
}

}  // namespace repose
