#pragma once

#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// Where the energy of a simulation went, since its beginning [J].
///
/// What was put in must be found again:
///   added + wall_work = kinetic + potential + elastic + dissipated + removed
/// with each term by a formula of its own: the states from positions and velocities, the dampers' losses from
/// their forces. Their difference, the imbalance, is what the step invented or lost. It is of the order of
/// the step where the motion is resolved and grows without bound where the step is too large.
///
/// What the tangential spring took and does not hold is friction: sliding, and the part of a spring that is
/// lost as its contact opens. It is negative where that spring gives more than it took.
struct EnergyLedger {
  // Of the bodies and contacts at present.
  double kinetic = 0.0;             ///< Σ ½ m v² + ½ ω·L
  double potential = 0.0;           ///< Σ m g z, z above the base's top
  double elastic_normal = 0.0;      ///< Σ 2/5 F_elastic δ (Hertz)
  double elastic_tangential = 0.0;  ///< Σ F_spring²/(2 S_t)
  double elastic_rolling = 0.0;     ///< Σ M_spring²/(2 k_r), of models with a rolling spring

  // Since the beginning.
  double added = 0.0;    ///< kinetic and potential of bodies put in, elastic where they touch
  double removed = 0.0;  ///< the same of bodies taken out
  double wall_work = 0.0;
  double normal_damping = 0.0;
  double tangential_damping = 0.0;
  double friction = 0.0;
  double rolling_resistance = 0.0;
  double turnover = 0.0;  ///< added + Σ |wall work of a step|: what the imbalance is compared with

  [[nodiscard]] double dissipated() const {
    return normal_damping + tangential_damping + friction + rolling_resistance;
  }
  [[nodiscard]] double elastic() const { return elastic_normal + elastic_tangential + elastic_rolling; }
  /// Energy found beyond what was put in [J]; negative: missing.
  [[nodiscard]] double imbalance() const {
    return kinetic + potential + elastic() + dissipated() + removed - added - wall_work;
  }
  /// Imbalance over turnover [-]; 0 where nothing has happened.
  [[nodiscard]] double relative_imbalance() const { return turnover > 0.0 ? imbalance() / turnover : 0.0; }
};

/// Contacts at one instant.
struct ContactSurvey {
  long contacts = 0;
  double elastic_normal = 0.0, elastic_tangential = 0.0, elastic_rolling = 0.0;  ///< [J]
  double largest_overlap = 0.0;  ///< δ over the smaller radius [-]
  double mean_overlap = 0.0;     ///< the same, over all contacts [-]
};

/// Looks at every contact that the last step found, one at a time. `walls` as of that step.
ContactSurvey survey_contacts(const ForceStep& step, RollingModel model, const Bodies& bodies,
                              const ContactList& contacts, std::span<const Wall> walls);

/// Kinetic and potential energy of a body at the time of the last step's forces, whose loads it still holds;
/// a body that no step has moved yet: nearly.
struct BodyEnergy {
  double kinetic = 0.0;    ///< [J]
  double potential = 0.0;  ///< [J]
};
BodyEnergy energy_of(const Bodies& bodies, std::size_t i, double dt, Integrator integrator);

}  // namespace repose
