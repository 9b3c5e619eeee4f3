#pragma once

#include <algorithm>
#include <cmath>

namespace repose::reference {

/// A head-on impact of two spheres, or of a sphere on a wall, under a damped Hertz law, by Runge–Kutta steps
/// of fourth order: independent of the engine's integrator, kernels and law.
///   m* δ'' = −(4/3 Y* √R* δ^{3/2} + γ √(S_n m*) δ')
struct NormalImpact {
  double Y_eff = 0.0;  ///< [Pa]
  double R_eff = 0.0;  ///< [m]
  double m_eff = 0.0;  ///< [kg]
  double gamma = 0.0;  ///< γ of the damping [-]
  bool clamped = false;
  int steps_per_contact = 4000;  ///< of the elastic contact's duration

  /// 2.868 (m*²/(R* Y*² v))^{1/5}: duration of the elastic contact [s].
  [[nodiscard]] double elastic_duration(double speed) const {
    return 2.868 * std::pow(m_eff * m_eff / (R_eff * Y_eff * Y_eff * speed), 0.2);
  }
  /// Force on the bodies, positive repulsive, at closing speed u = dδ/dt.
  [[nodiscard]] double force(double overlap, double u) const {
    if (overlap <= 0.0) return 0.0;
    const double root = std::sqrt(R_eff * overlap);
    const double total =
        4.0 / 3.0 * Y_eff * root * overlap + gamma * std::sqrt(2.0 * Y_eff * root * m_eff) * u;
    return clamped ? std::max(total, 0.0) : total;
  }
  struct State {
    double overlap = 0.0;
    double closing = 0.0;  ///< dδ/dt
  };
  [[nodiscard]] State advanced(const State& s, double dt) const {
    const auto rate = [this](const State& at) {
      return State{at.closing, -force(at.overlap, at.closing) / m_eff};
    };
    const auto moved = [](const State& at, const State& slope, double h) {
      return State{at.overlap + h * slope.overlap, at.closing + h * slope.closing};
    };
    const State k1 = rate(s), k2 = rate(moved(s, k1, 0.5 * dt)), k3 = rate(moved(s, k2, 0.5 * dt)),
                k4 = rate(moved(s, k3, dt));
    return {s.overlap + dt / 6.0 * (k1.overlap + 2.0 * (k2.overlap + k3.overlap) + k4.overlap),
            s.closing + dt / 6.0 * (k1.closing + 2.0 * (k2.closing + k3.closing) + k4.closing)};
  }
  /// Separation speed after an impact at `speed`.
  [[nodiscard]] double rebound(double speed) const {
    const double dt = elastic_duration(speed) / steps_per_contact;
    State state{0.0, speed};
    // The clamp lets go with overlap left: from then on the speed stays.
    do {
      state = advanced(state, dt);
    } while (state.overlap > 0.0 &&
             !(state.closing < 0.0 && force(state.overlap, state.closing) <= 0.0 && clamped));
    return -state.closing;
  }
};

/// γ with which the rebound is e, by bisection of the impact itself: no formula of β(e). The law scales, so
/// that any stiffness, mass and speed give the same.
inline double gamma_for_rebound(double e, bool clamped) {
  if (e == 1.0) return 0.0;
  NormalImpact impact{1.0, 1.0, 1.0, 0.0, clamped};
  const auto rebounds_more = [&](double gamma) {
    impact.gamma = gamma;
    return impact.rebound(1.0) > e;
  };
  // Doubled from small: far above the critical damping an impact creeps and does not end.
  double low = 0.0, high = 0.2;
  while (rebounds_more(high)) low = high, high *= 2.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (rebounds_more(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace repose::reference
