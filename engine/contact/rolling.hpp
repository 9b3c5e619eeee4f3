#pragma once

#include "engine/contact/law_parameters.hpp"
#include "engine/contact/simd.hpp"

namespace repose {

/// What the rolling torque of a pair needs of its contact.
template <class T>
struct RollingContact {
  Triple<T> n;      ///< from j to i
  Triple<T> w_rel;  ///< ω_i − ω_j [rad/s]
  T R_eff;          ///< R* of the touching spheres [m]; R_i at a wall
  T stiffness;  ///< type_c: secant normal stiffness k_n = 4/3 Y* √(R* δ); type_c_undamped: S_t = 8 G* √(R* δ)
                ///< [N/m]
  T F_elastic;         ///< elastic part of F_n [N]
  T F_n;               ///< F_n [N]
  T inertia_or_limit;  ///< type_c: I_r about the contact point [kg m²]; type_a_relative: largest torque per
                       ///< |ω_rel| [N m s]
};

/// The part of a vector across the normal: rolling without torsion.
template <class T>
REPOSE_INLINE Triple<T> across(const Triple<T>& vector, const Triple<T>& n) {
  return vector - dot(vector, n) * n;
}

/// |ω_rel|, or 1 where nothing turns, so that it can be divided by, and so can its product with other
/// factors.
template <class T>
REPOSE_INLINE T spin_or_one(const Triple<T>& w_rel) {
  const T spin = length(w_rel);
  return select(spin > kNothing<T>, spin, T(1.0));
}

/// Constant torque against the relative rotation (type_a_relative, LIGGGHTS `cdt`):
///   M = −μr |F_elastic| R* ω_rel/|ω_rel|, without its part along n.
/// Bounded (LawParameters::torque_limited) by what stops the relative rotation within one step, shared over
/// the contacts of both bodies (inertia_or_limit): unbounded, the sign of ω_rel flips at every step of a heap
/// at rest, which then never rests.
/// @param inverse_spin  1/|ω_rel|, of spin_or_one
/// @return torque on i; on j the opposite [N m]
template <class T>
REPOSE_INLINE Triple<T> constant_torque(const LawParameters& law, const RollingContact<T>& contact,
                                        const T& inverse_spin) {
  const T full = law.rolling * absolute(contact.F_elastic) * contact.R_eff;
  T factor = full * inverse_spin;
  if (law.torque_limited) factor = smaller(factor, contact.inertia_or_limit);
  return T(-factor) * across(contact.w_rel, contact.n);
}

/// Elastic–plastic rolling spring (Ai et al. 2011, model C; LIGGGHTS `epsd`, `epsd2`):
///   M ← M − k_r ω_roll Δt, |M| ≤ μr R* |F_n|
///   type_c: k_r = 2.25 k_n μr² R*², plus −2 η_r √(I_r k_r) ω_roll until fully mobilised
///   type_c_undamped: k_r = S_t R*², no viscous part
/// @param spring  in and out: the spring's torque on i [N m]
/// @return torque on i; on j the opposite [N m]
template <RollingModel kModel, class T>
REPOSE_INLINE Triple<T> rolling_spring(const LawParameters& law, const RollingContact<T>& contact, double dt,
                                       Triple<T>& spring) {
  static_assert(kModel == RollingModel::type_c || kModel == RollingModel::type_c_undamped);
  constexpr bool kDamped = kModel == RollingModel::type_c;
  const T k_r =
      (kDamped ? 2.25 * law.rolling * law.rolling : 1.0) * contact.stiffness * contact.R_eff * contact.R_eff;
  const Triple<T> w_roll = across(contact.w_rel, contact.n);
  const Triple<T> trial = across(spring, contact.n) - (k_r * dt) * w_roll;
  const T limit = law.rolling * contact.R_eff * absolute(contact.F_n);
  const T size = length(trial);
  const auto mobilised = size > limit;
  spring = select(mobilised, T(limit / select(mobilised, size, T(1.0))), T(1.0)) * trial;
  if constexpr (!kDamped) return spring;
  const T c_r = 2.0 * law.rolling_damping * square_root(T(contact.inertia_or_limit * k_r));
  return spring - select(mobilised, T(0.0), c_r) * w_roll;
}

}  // namespace repose
