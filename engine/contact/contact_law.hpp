#pragma once

#include "engine/contact/hertz_mindlin.hpp"
#include "engine/contact/rolling.hpp"

namespace repose {

/// Whether a contact remembers a rolling spring.
inline constexpr bool has_rolling_spring(RollingModel model) {
  return model == RollingModel::type_c || model == RollingModel::type_c_undamped;
}

/// Motion of one side of a contact.
template <class T>
struct ContactSide {
  Triple<T> velocity;  ///< of the centre of mass [m/s]
  Triple<T> w;         ///< ω [rad/s]
  Triple<T> arm;       ///< contact point − centre of mass [m]
};

/// Geometry of one contact.
template <class T>
struct ContactGeometry {
  Triple<T> n;         ///< unit normal, from j to i
  T overlap;           ///< δ > 0 [m]
  T R_eff;             ///< R* [m]
  T m_eff;             ///< m* [kg]
  T inertia_or_limit;  ///< see RollingContact
  T inverse_m_eff;     ///< 1/m* [1/kg]; used where ContactTiming::lag is
};

/// How the sides of a contact move against one another.
template <class T>
struct ContactMotion {
  Triple<T> v;      ///< v_i − v_j at the contact point [m/s]
  Triple<T> w_rel;  ///< ω_i − ω_j [rad/s]
  T w_normal;       ///< (ω_i + ω_j)·n [rad/s]
};

template <class T>
REPOSE_INLINE ContactMotion<T> relative_motion(const Triple<T>& n, const ContactSide<T>& i,
                                               const ContactSide<T>& j) {
  return {(i.velocity + cross(i.w, i.arm)) - (j.velocity + cross(j.w, j.arm)), i.w - j.w, dot(i.w + j.w, n)};
}

template <class T>
struct ContactHistory {
  TangentialSpring<T> tangential;
  Triple<T> rolling;  ///< torque of the rolling spring on i [N m]
};

/// What a contact takes from the motion of its bodies, each part where it is positive [W].
///
/// A step moves the bodies by v Δt with the velocity that the law is given, which belongs to the middle
/// between the last step and this one. The springs' work over that interval is the mean of their forces at
/// its two ends times v: exact for a linear spring, where this step's force alone would take ½ S (v Δt)² too
/// much each time. The dampers' force f is of this step and acts from the middle of the last interval to that
/// of the next, over which the mean velocity is v + lag F/m, with ContactTiming::lag. F/m is taken of this
/// contact alone, m* along the normal and 2/7 m* (two solid spheres) along the tangent: 1/m* of the centres
/// and 2.5/m* of the spins. Of the latter type_a's resistance takes back the part that its torque is of the
/// tangential force's, min(1, μr |F_n|/|F_t|). What the other contacts of the bodies add averages out.
template <class T>
struct ContactPower {
  T normal_damping, tangential_damping;
  T spring;   ///< of the tangential spring, and all of a contact that slides: stored, or lost to friction
  T rolling;  ///< of the rolling torque: stored in its spring, or dissipated
};

/// How the velocities of a contact's sides relate to the time of its geometry.
template <class T>
struct ContactTiming {
  double dt = 0.0;   ///< Δt [s]
  double lag = 0.0;  ///< Δt/2 where damping is given velocities half a step behind the geometry, else 0 [s]
  bool booked = true;               ///< whether ContactForces::power is wanted; it is not set otherwise
  const Triple<T>* lead = nullptr;  ///< added to the relative velocity for damping alone [m/s]; may be null
};

template <class T>
struct ContactForces {
  Triple<T> force;           ///< on i at the contact point; on j the opposite [N]
  Triple<T> rolling_torque;  ///< on i; on j the opposite [N m]; zero under type_a
  T F_n;                     ///< total normal force, positive repulsive [N]
  ContactPower<T> power;
};

/// By how much more than its centres of mass the surfaces of a pair yield to a tangential force, with
/// ContactPower's derivation.
template <RollingModel kModel, class T>
REPOSE_INLINE T tangential_yield(const LawParameters& law, const T& F_n, const Triple<T>& F_t) {
  if constexpr (kModel != RollingModel::type_a) return 3.5;
  const T size = length(F_t), resisted = smaller(T(law.rolling * absolute(F_n)), size);
  return 3.5 - 2.5 * resisted / select(size > kNothing<T>, size, T(1.0));
}

/// 1/a, 1/b and 1/c, in one division where that pays.
template <class T>
struct Inverses {
  T of_a, of_b, of_c;

  REPOSE_INLINE Inverses(const T& a, const T& b, const T& c) {
    if constexpr (kSharesDivisions<T>) {
      const T inverse = 1.0 / (a * b * c);
      of_a = inverse * b * c, of_b = inverse * a * c, of_c = inverse * a * b;
    } else {
      of_a = 1.0 / a, of_b = 1.0 / b, of_c = 1.0 / c;
    }
  }
};

/// Force and rolling torque of one contact, and its history brought to this step. type_a's torque, which
/// depends on each body's own ω, is not here: the integrator applies it from Σ μr |F_n| R_i
/// (dynamics/integrate.hpp).
/// The rolling model is a template argument because it decides what a contact remembers; the two other
/// choices of law are uniform branches, which cost nothing measurable.
template <RollingModel kModel, class T>
REPOSE_INLINE ContactForces<T> contact_forces(const LawParameters& law, const ContactGeometry<T>& contact,
                                              const ContactMotion<T>& motion, const ContactTiming<T>& timing,
                                              ContactHistory<T>& history) {
  const double dt = timing.dt;
  const T v_normal = dot(motion.v, contact.n);
  const Triple<T> v_tangent = motion.v - v_normal * contact.n;
  T v_normal_damped = v_normal;
  Triple<T> v_tangent_damped = v_tangent;
  if (timing.lead != nullptr) {
    const T along = dot(*timing.lead, contact.n);
    v_normal_damped = v_normal + along;
    v_tangent_damped = v_tangent + *timing.lead - along * contact.n;
  }
  const ContactStiffness<T> stiffness = contact_stiffness(law, contact.R_eff, contact.m_eff, contact.overlap);
  const NormalForce<T> normal = normal_force(law, stiffness, contact.overlap, v_normal_damped);

  const TurnedSpring<T> turned =
      turned_spring(history.tangential.value, contact.n, T(0.5 * dt * motion.w_normal));
  const auto known = history.tangential.root > 0.0;
  const T root_before = select(known, history.tangential.root, T(1.0));
  T spin = 1.0;
  if constexpr (kModel == RollingModel::type_a_relative) spin = spin_or_one(motion.w_rel);
  const Inverses<T> inverse(turned.after, root_before, spin);
  history.tangential.value = turned.with_old_length(inverse.of_a);
  const T unloading = stiffness.root * inverse.of_b;
  const TangentialForce<T> tangent = tangential_force(law, stiffness, normal.total, v_tangent,
                                                      v_tangent_damped, unloading, dt, history.tangential);

  ContactForces<T> result;
  result.force = normal.total * contact.n + tangent.total;
  result.rolling_torque = {T(0.0), T(0.0), T(0.0)};
  result.F_n = normal.total;
  if (timing.booked) {
    const T per_mass = timing.lag * contact.inverse_m_eff;
    const T yield = per_mass * tangential_yield<kModel>(law, normal.total, tangent.total);
    const T damped = dot(tangent.damping, v_tangent_damped) + yield * dot(tangent.damping, tangent.total);
    result.power.normal_damping =
        (normal.elastic - normal.total) * (v_normal_damped + per_mass * normal.total);
    result.power.tangential_damping = select(tangent.kept < 1.0, T(0.0), damped);
    result.power.spring =
        (damped - result.power.tangential_damping) - 0.5 * dot(tangent.previous + tangent.spring, v_tangent);
    result.power.rolling = T(0.0);
  }
  if constexpr (kModel != RollingModel::type_a) {
    const double modulus = kModel == RollingModel::type_c ? (4.0 / 3.0) * law.young : 8.0 * law.shear;
    const RollingContact<T> rolling{
        contact.n,      motion.w_rel, contact.R_eff,           modulus * stiffness.root,
        normal.elastic, normal.total, contact.inertia_or_limit};
    Triple<T> mean;
    if constexpr (has_rolling_spring(kModel)) {
      const Triple<T> previous = history.rolling;
      result.rolling_torque = rolling_spring<kModel>(law, rolling, dt, history.rolling);
      mean = result.rolling_torque - T(0.5) * (history.rolling - previous);
    } else {
      mean = result.rolling_torque = constant_torque(law, rolling, inverse.of_c);
    }
    if (timing.booked) result.power.rolling = T(0.0) - dot(mean, rolling.w_rel);
  }
  return result;
}

}  // namespace repose
