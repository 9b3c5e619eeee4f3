#include "engine/base/random.hpp"

#include <cmath>

namespace repose {

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * kPi * uniform());
}

Quat RandomStream::rotation() {
  const double u = uniform();
  const double a = 2.0 * kPi * uniform();
  const double b = 2.0 * kPi * uniform();
  const double s = std::sqrt(1.0 - u);
  const double c = std::sqrt(u);
  return Quat(c * std::cos(b), s * std::sin(a), s * std::cos(a), c * std::sin(b));
}

}  // namespace repose
