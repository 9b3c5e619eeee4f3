#pragma once

#include "reference/normal_impact.hpp"

namespace repose::reference {

/// An oblique impact in one plane, by small steps of scalars: the normal motion by NormalImpact, the
/// tangential motion by the midpoint rule with a spring that follows the contact's radius. No vectors, no
/// history to turn, none of the engine's code.
///   dv_s/dt = F_t (1/m* + Σ arm²/I),   dF_s = −S_t v_s dt (+ F_s da/a on unloading),   |F_t| ≤ μ |F_n|
struct PlanarImpact {
  NormalImpact normal;
  double G_eff = 0.0;
  double gamma_t = 0.0;   ///< F_d = −γ_t √(S_t m*) v_s
  double friction = 0.0;  ///< μ
  double radius_i = 0.0;  ///< of the spheres [m]; a wall has no radius_j and no mobility_j
  double radius_j = 0.0;
  double mobility = 0.0;   ///< 1/m* for translation [1/kg]
  double turning_i = 0.0;  ///< 1/I [1/(kg m²)]
  double turning_j = 0.0;
  int steps = 40000;

  struct Result {
    double slip = 0.0;      ///< relative surface velocity at the end [m/s]
    double impulse = 0.0;   ///< ∫ F_t dt [N s]
    double torque_i = 0.0;  ///< ∫ F_t arm_i dt [N m s]
    double closing = 0.0;   ///< dδ/dt at the end [m/s]
  };

  [[nodiscard]] Result run(double closing, double slip) const {
    const double dt = normal.elastic_duration(closing) / steps;
    NormalImpact::State now{0.0, closing};
    Result result;
    result.slip = slip;
    double spring = 0.0, a_old = 0.0;
    for (;;) {
      const NormalImpact::State next = normal.advanced(now, dt);
      if (next.overlap <= 0.0) break;
      const double a = std::sqrt(normal.R_eff * next.overlap);
      const double S_t = 8.0 * G_eff * a;
      const double c = gamma_t * std::sqrt(S_t * normal.m_eff);
      const double limit = friction * std::abs(normal.force(next.overlap, next.closing));
      if (a < a_old) spring *= a / a_old;
      spring -= S_t * result.slip * dt;
      const double force = std::clamp(spring - c * result.slip, -limit, limit);
      spring = force + c * result.slip;
      const double arm_i = radius_i - 0.5 * next.overlap,
                   arm_j = radius_j > 0.0 ? radius_j - 0.5 * next.overlap : 0.0;
      result.slip += dt * force * (mobility + arm_i * arm_i * turning_i + arm_j * arm_j * turning_j);
      result.impulse += dt * force;
      result.torque_i += dt * force * arm_i;
      now = next;
      a_old = a;
    }
    result.closing = now.closing;
    return result;
  }
};

}  // namespace repose::reference
