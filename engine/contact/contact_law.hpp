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
};

template <class T>
struct ContactHistory {
  TangentialSpring<T> tangential;
  Triple<T> rolling;  ///< torque of the rolling spring on i [N m]
};

template <class T>
struct ContactForces {
  Triple<T> force;           ///< on i at the contact point; on j the opposite [N]
  Triple<T> rolling_torque;  ///< on i; on j the opposite [N m]; zero under type_a
  T F_n;                     ///< total normal force, positive repulsive [N]
};

/// Force and rolling torque of one contact, and its history brought to this step. type_a's torque, which
/// depends on each body's own ω, is not here: the integrator applies it from Σ μr |F_n| R_i
/// (dynamics/integrate.hpp).
/// The rolling model is a template argument because it decides what a contact remembers; the two other
/// choices of law are uniform branches, which cost nothing measurable.
template <RollingModel kModel, class T>
REPOSE_INLINE ContactForces<T> contact_forces(const LawParameters& law, const ContactGeometry<T>& contact,
                                              const ContactSide<T>& i, const ContactSide<T>& j, double dt,
                                              ContactHistory<T>& history) {
  const Triple<T> v = (i.velocity + cross(i.w, i.arm)) - (j.velocity + cross(j.w, j.arm));
  const T v_normal = dot(v, contact.n);
  const Triple<T> v_tangent = v - v_normal * contact.n;
  const ContactStiffness<T> stiffness = contact_stiffness(law, contact.R_eff, contact.m_eff, contact.overlap);
  const NormalForce<T> normal = normal_force(law, stiffness, contact.overlap, v_normal);

  history.tangential.value = turned_spring(history.tangential.value, contact.n, i.w, j.w, dt);
  const Triple<T> tangent = tangential_force(law, stiffness, normal.total, v_tangent, dt, history.tangential);

  ContactForces<T> result{normal.total * contact.n + tangent, {T(0.0), T(0.0), T(0.0)}, normal.total};
  if constexpr (kModel != RollingModel::type_a) {
    const double modulus = kModel == RollingModel::type_c ? (4.0 / 3.0) * law.young : 8.0 * law.shear;
    const RollingContact<T> rolling{
        contact.n,      i.w - j.w,    contact.R_eff,           modulus * stiffness.root,
        normal.elastic, normal.total, contact.inertia_or_limit};
    if constexpr (has_rolling_spring(kModel)) {
      result.rolling_torque = rolling_spring<kModel>(law, rolling, dt, history.rolling);
    } else {
      result.rolling_torque = constant_torque(law, rolling);
    }
  }
  return result;
}

}  // namespace repose
