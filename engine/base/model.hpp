#pragma once

namespace repose {

/// Rolling resistance of a contact (equations: engine/contact/rolling.hpp).
enum class RollingModel { type_a, type_a_relative, type_c, type_c_undamped };

/// What a contact remembers of its tangential spring: the force (rescaled on unloading, creates no energy) or
/// the displacement (as LIGGGHTS and EDEM do).
enum class TangentialHistory { force, displacement };

/// with_tail: the short attraction at separation is kept (Tsuji damping, e exact); clamped: Fn ≥ 0 with the
/// damping of Thornton et al. 2013.
enum class NormalDamping { with_tail, clamped };

/// Whether the torque of type_a and type_a_relative ends where it has stopped the rotation within a step.
/// Without that limit its sign flips at every step of a heap at rest.
enum class RollingTorque { limited, unlimited };

/// How forces become motion (equations and orders: engine/dynamics/integrate.hpp).
enum class Integrator { symplectic_euler, velocity_verlet, explicit_euler };

/// In what precision contacts between particles are computed (contact/single.hpp). mixed: relative motion,
/// contact law and the forces of one contact in single precision; positions, what touches and by how much,
/// sums of forces and motion in double precision as always.
enum class Arithmetic { double_precision, mixed };

}  // namespace repose
