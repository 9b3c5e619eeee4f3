#pragma once

#include "engine/contact/law_parameters.hpp"
#include "engine/contact/simd.hpp"

namespace repose {

/// Stiffness and damping that the normal and the tangential force of one contact share.
/// The derivation: S_n = 2 Y* √(R* δ) and S_t = 8 G* √(R* δ) hold the same root, so one √(R* δ) and one √(S_n
/// m*) serve both forces: γ_t √(S_n m*) = γ √(S_t m*) with γ_t = γ √(4 G*/Y*), which
/// LawParameters::tangent_damping holds.
template <class T>
struct ContactStiffness {
  T root;         ///< √(R* δ), the radius of the contact area [m]
  T root_normal;  ///< √(S_n m*) [kg/s]
};

template <class T>
REPOSE_INLINE ContactStiffness<T> contact_stiffness(const LawParameters& law, const T& R_eff, const T& m_eff,
                                                    const T& overlap) {
  const T root = square_root(T(R_eff * overlap));
  return {root, square_root(T(2.0 * law.young * root * m_eff))};
}

template <class T>
struct NormalForce {
  T elastic;  ///< 4/3 Y* √R* δ^{3/2} [N]
  T total;    ///< with damping, positive repulsive [N]
};

/// Damped Hertz normal force.
///   F_n = 4/3 Y* √R* δ^{3/2} − γ_n √(S_n m*) v_n,   clamped: F_n ≥ 0
/// @param overlap   δ > 0 [m]
/// @param v_normal  (v_i − v_j)·n [m/s], n from j to i, negative on approach
/// Source: article eq. 3 with δ^{3/2}; Tsuji et al. 1992; Antypov & Elliott 2011; clamped: Thornton et al.
/// 2013.
template <class T>
REPOSE_INLINE NormalForce<T> normal_force(const LawParameters& law, const ContactStiffness<T>& stiffness,
                                          const T& overlap, const T& v_normal) {
  const T elastic = (4.0 / 3.0) * law.young * stiffness.root * overlap;
  T total = elastic - law.normal_damping * stiffness.root_normal * v_normal;
  if (law.clamped) total = larger(total, T(0.0));
  return {elastic, total};
}

/// The tangential spring of one contact, as it is remembered from step to step.
template <class T>
struct TangentialSpring {
  Triple<T> value;  ///< force [N] or displacement [m], by TangentialHistory; in the contact's tangent plane
  T root;           ///< √(R* δ) of the last step [m]; 0 for a new contact
};

/// The spring of the last step, turned into the tangent plane of this one but not yet with its old length.
template <class T>
struct TurnedSpring {
  Triple<T> flat;
  T before;  ///< square of the old length
  T after;   ///< square of the length of `flat`; 1 where there is none

  /// @param inverse_after  1/after
  REPOSE_INLINE Triple<T> with_old_length(const T& inverse_after) const {
    return square_root(T(before * inverse_after)) * flat;
  }
};

/// The spring of the last step, carried with the contact as the pair moves: turned with its normal and with
/// the mean spin of the two bodies about it, so that a pair that rotates as one body keeps its tangential
/// force.
///   s ← s + φ (n × s), φ = Δt ½(ω_i + ω_j)·n;   s ← s − (s·n) n, with its old length
/// Projection leaves the tangent plane to second order in the angle of a step; the old length is restored
/// exactly.
template <class T>
REPOSE_INLINE TurnedSpring<T> turned_spring(const Triple<T>& spring, const Triple<T>& n, const T& spin) {
  const Triple<T> spun = spring + spin * cross(n, spring);
  const Triple<T> flat = spun - dot(spun, n) * n;
  const T after = dot(flat, flat);
  return {flat, dot(spring, spring), select(after > kNothing<T>, after, T(1.0))};
}

template <class T>
struct TangentialForce {
  Triple<T> total;     ///< on i, limited by friction [N]
  Triple<T> damping;   ///< γ_t √(S_n m*) v_t, as far as the total holds it [N]
  Triple<T> spring;    ///< total + damping: what the spring exerts, limited [N]
  Triple<T> previous;  ///< what the spring of the last step, turned, exerts [N]
  T kept;              ///< below 1 where the limit acts: the contact slides
};

/// Mindlin tangential force without micro-slip, limited by Coulomb friction.
///   s ← s + v_t Δt (displacement)   or   s ← s min(1, a/a_old) − S_t v_t Δt (force), a = √(R* δ), S_t = 8 G*
///   a F_t = spring − γ_t √(S_n m*) v_t,   |F_t| ≤ μs |F_n|
/// A stored force is scaled down with the contact's radius on unloading: without it, shearing at a large
/// overlap and back at a small one returns more work than it took (Thornton & Randall 1988; Thornton, Cummins
/// & Cleary 2011). When the limit acts on a stored force, spring and
/// damping together make the limited force. A stored displacement is cut to what makes the limited force by
/// itself, and a contact that slides is not damped (as LIGGGHTS does): with the damping's share stored as a
/// displacement, S_t would multiply it as the overlap grows, which took up to 90 % off the friction of an
/// impact at e = 0.1.
/// @param v_tangent  (v_i − v_j) − v_n n at the contact point, by which the spring is stretched [m/s]
/// @param v_damped   the same for damping; another where velocities are carried on in time
/// @param unloading  a/a_old; anything for a new contact
/// @param spring     in: turned spring of the last step; out: of this one
/// Source: article eq. 4; Mindlin & Deresiewicz 1953.
template <class T>
REPOSE_INLINE TangentialForce<T> tangential_force(const LawParameters& law,
                                                  const ContactStiffness<T>& stiffness, const T& F_n,
                                                  const Triple<T>& v_tangent, const Triple<T>& v_damped,
                                                  const T& unloading, double dt,
                                                  TangentialSpring<T>& spring) {
  const T S_t = 8.0 * law.shear * stiffness.root;
  TangentialForce<T> force;
  force.damping = (law.tangent_damping * stiffness.root_normal) * v_damped;
  const T limit = law.friction * absolute(F_n);
  const auto cut = [&limit](const Triple<T>& vector) {  // the factor that brings a vector down to the limit
    const T size = length(vector);
    const auto beyond = size > limit;
    return select(beyond, T(limit / select(beyond, size, T(1.0))), T(1.0));
  };
  if (law.history == TangentialHistory::force) {
    const Triple<T> damped =
        smaller(unloading, T(1.0)) * spring.value - (S_t * dt) * v_tangent - force.damping;
    force.previous = spring.value;
    force.kept = cut(damped);
    force.total = force.kept * damped;
    spring.value = force.spring = force.total + force.damping;
  } else {
    const Triple<T> stretched = spring.value + T(dt) * v_tangent;
    const Triple<T> elastic = T(-S_t) * stretched;
    const auto slides = dot(elastic, elastic) > limit * limit;
    const Triple<T> none{T(0.0), T(0.0), T(0.0)};
    const Triple<T> damped = elastic - select3(slides, none, force.damping);
    force.previous = T(-8.0 * law.shear) * spring.root * spring.value;
    force.kept = cut(damped);
    force.total = force.kept * damped;
    const T kept = select(slides, force.kept, T(1.0));
    force.spring = kept * elastic;
    force.damping = force.spring - force.total;
    spring.value = kept * stretched;
  }
  spring.root = stiffness.root;
  return force;
}

}  // namespace repose
