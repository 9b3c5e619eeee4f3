#pragma once

#include "engine/base/vec3.hpp"

namespace repose::reference {

/// Orientation of a free body after a time, by Runge–Kutta steps of fourth order of
///   dq/dt = (0, ω) q / 2,   ω = R I⁻¹ Rᵀ L,   L constant.
inline Quat free_rotation(const Vec3& moments, const Vec3& angular_momentum, Quat start, double time,
                          int steps) {
  using Vec4 = Eigen::Vector4d;  // x, y, z, w
  const auto rate = [&](const Vec4& q) -> Vec4 {
    const Mat3 turn = Quat(Vec4(q.normalized())).toRotationMatrix();
    const Vec3 w = turn * (turn.transpose() * angular_momentum).cwiseQuotient(moments);
    return 0.5 * (Quat(0.0, w.x(), w.y(), w.z()) * Quat(q)).coeffs();
  };
  Vec4 q = start.coeffs();
  const double dt = time / steps;
  for (int k = 0; k < steps; ++k) {
    const Vec4 k1 = rate(q), k2 = rate(q + 0.5 * dt * k1), k3 = rate(q + 0.5 * dt * k2),
               k4 = rate(q + dt * k3);
    q += dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
  }
  return Quat(Vec4(q.normalized()));
}

}  // namespace repose::reference
