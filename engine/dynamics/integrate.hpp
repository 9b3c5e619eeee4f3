#pragma once

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"

namespace repose {

/// Moves all bodies by one step Δt under gravity and what contacts have added up in Bodies::load.
///
/// Translation is leapfrog: velocities live at half steps, v ← v + Δt (F/m + g), x ← x + Δt v; second order
/// where F depends on positions alone.
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
/// step of a heap at rest, which then keeps moving.
void integrate(Bodies& bodies, double dt, bool rolling_type_a);

}  // namespace repose
