#include "engine/contact/law_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/vec3.hpp"

namespace repose {

double damping_ratio(double restitution) {
  if (restitution <= 0.0) return 1.0;
  const double log_e = std::log(restitution);
  return -log_e / std::sqrt(log_e * log_e + kPi * kPi);
}

double clamped_damping_ratio(double restitution) {
  const double loss = -std::log(std::clamp(restitution, 0.01, 1.0));
  // Both halves of the curve rise with their variable; a bisection to the last bit costs nothing once per
  // law.
  const auto solve = [loss](double low, double high, auto curve) {
    for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
      (curve(middle) < loss ? low : high) = middle;
    return high;
  };
  double ratio = 0.0;
  if (loss > 2.0) {
    ratio = std::cosh(solve(0.0, loss, [](double b) { return 2.0 * b / std::tanh(b); }));
  } else if (loss > 0.0) {
    ratio = std::sin(solve(0.0, 0.5 * kPi, [](double a) { return (kPi - 2.0 * a) * std::tan(a); }));
  }
  return ratio / std::sqrt(1.2);
}

LawParameters law_parameters(const ElasticSide& a, const ElasticSide& b, double restitution,
                             double static_friction, double rolling_friction, double rolling_damping_ratio,
                             NormalDamping damping, TangentialHistory history) {
  const auto compliance = [](const ElasticSide& side) {
    const double young = 2.0 * side.shear_modulus * (1.0 + side.poisson_ratio);
    return (1.0 - side.poisson_ratio * side.poisson_ratio) / young;
  };
  const auto shear_compliance = [](const ElasticSide& side) {
    return (2.0 - side.poisson_ratio) / side.shear_modulus;
  };
  LawParameters law;
  law.young = 1.0 / (compliance(a) + compliance(b));
  law.shear = 1.0 / (shear_compliance(a) + shear_compliance(b));
  const double tail = 2.0 * std::sqrt(5.0 / 6.0) * damping_ratio(restitution);
  law.normal_damping = damping == NormalDamping::with_tail ? tail : 2.0 * clamped_damping_ratio(restitution);
  law.tangent_damping = tail * std::sqrt(4.0 * law.shear / law.young);
  law.friction = static_friction;
  law.rolling = rolling_friction;
  law.rolling_damping = rolling_damping_ratio;
  law.clamped = damping == NormalDamping::clamped;
  law.history = history;
  return law;
}

}  // namespace repose
