#pragma once

#include <cmath>

#include "engine/base/model.hpp"
#include "engine/base/vec3.hpp"

namespace repose::reference {

/// The contact laws once more, written from the equations one contact at a time, without sharing a line with
/// the engine: equivalent values pair by pair, S_n and S_t as they stand in the literature, damping by its
/// own square root each.
struct Elastic {
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson_ratio = 0.0;  ///< ν [-]

  [[nodiscard]] double young() const { return 2.0 * shear_modulus * (1.0 + poisson_ratio); }
};

struct ContactMaterial {
  Elastic a, b;
  double e = 1.0;         ///< restitution [-]
  double friction = 0.0;  ///< μs [-]
  double rolling = 0.0;   ///< μr [-]
  double rolling_damping = 0.3;
  RollingModel model = RollingModel::type_a;
  TangentialHistory history = TangentialHistory::force;
  NormalDamping damping = NormalDamping::with_tail;
  double beta_clamped = 0.0;  ///< damping ratio of the clamped law, F_d = −2 β √(S_n m*) v_n

  [[nodiscard]] double Y_eff() const {
    return 1.0 / ((1.0 - a.poisson_ratio * a.poisson_ratio) / a.young() +
                  (1.0 - b.poisson_ratio * b.poisson_ratio) / b.young());
  }
  [[nodiscard]] double G_eff() const {
    return 1.0 / ((2.0 - a.poisson_ratio) / a.shear_modulus + (2.0 - b.poisson_ratio) / b.shear_modulus);
  }
  [[nodiscard]] double beta() const {
    if (e == 0.0) return 1.0;
    return 1.0 / std::sqrt(1.0 + std::pow(kPi / std::log(e), 2));
  }
  /// The fit of Thornton, Cummins & Cleary 2013.
  [[nodiscard]] double published_beta_clamped() const {
    const double h[] = {-6.918798, -16.41105, 146.8049,  -796.4559, 2928.711,
                        -7206.864, 11494.29,  -11342.18, 6276.757,  -1489.915};
    double alpha = 0.0;
    for (int k = 0; k < 10; ++k) alpha += h[k] * std::pow(e, k + 1);
    return std::sqrt(1.0 / (1.0 - std::pow(1.0 + e, 2) * std::exp(alpha)) - 1.0);
  }
};

struct PlainSide {
  Vec3 velocity = Vec3::Zero();  ///< of the centre of mass
  Vec3 w = Vec3::Zero();
  Vec3 arm = Vec3::Zero();  ///< contact point − centre of mass

  [[nodiscard]] Vec3 at_contact() const { return velocity + w.cross(arm); }
};

struct PlainContact {
  Vec3 n = Vec3::UnitZ();  ///< from j to i
  double overlap = 0.0;
  double R_eff = 0.0;
  double m_eff = 0.0;
  double rolling_inertia = 0.0;  ///< type_c: I_r about the contact point
  double most_per_spin = 0.0;    ///< type_a_relative: largest torque per |ω_rel|
};

struct PlainMemory {
  Vec3 spring = Vec3::Zero();  ///< force or displacement
  double radius = 0.0;         ///< √(R* δ) at the last step
  Vec3 rolling = Vec3::Zero();
};

struct PlainForces {
  Vec3 force = Vec3::Zero();   ///< on i
  Vec3 torque = Vec3::Zero();  ///< rolling torque on i
  double F_n = 0.0;
  /// What the force is the sum of, each part by its size: what rounding is to be compared with.
  double parts = 0.0;
};

inline Vec3 tangent_part(const Vec3& v, const Vec3& n) { return v - v.dot(n) * n; }

inline Vec3 shortened_to(const Vec3& v, double most) {
  const double size = v.norm();
  return size > most ? Vec3(v * (most / size)) : v;
}

/// Torque of the rolling models that act on a pair.
inline Vec3 plain_rolling(const ContactMaterial& material, const PlainContact& c, const Vec3& w_rel,
                          double F_elastic, double F_n, double dt, PlainMemory& memory) {
  if (material.model == RollingModel::type_a) return Vec3::Zero();
  if (material.model == RollingModel::type_a_relative) {
    if (w_rel.norm() == 0.0) return Vec3::Zero();
    const double size =
        std::min(material.rolling * std::abs(F_elastic) * c.R_eff, c.most_per_spin * w_rel.norm());
    return tangent_part(-size * w_rel.normalized(), c.n);
  }
  const double limit = material.rolling * c.R_eff * std::abs(F_n);
  const double a = std::sqrt(c.R_eff * c.overlap);
  const bool damped = material.model == RollingModel::type_c;
  const double k = damped
                       ? 2.25 * (4.0 / 3.0 * material.Y_eff() * a) * std::pow(material.rolling * c.R_eff, 2)
                       : 8.0 * material.G_eff() * a * c.R_eff * c.R_eff;
  const Vec3 w_roll = tangent_part(w_rel, c.n);
  const Vec3 trial = tangent_part(memory.rolling, c.n) - k * dt * w_roll;
  memory.rolling = shortened_to(trial, limit);
  if (!damped || trial.norm() > limit) return memory.rolling;
  return memory.rolling - 2.0 * material.rolling_damping * std::sqrt(c.rolling_inertia * k) * w_roll;
}

/// One contact, one step.
inline PlainForces plain_contact(const ContactMaterial& material, const PlainContact& c, const PlainSide& i,
                                 const PlainSide& j, double dt, PlainMemory& memory) {
  const Vec3 v = i.at_contact() - j.at_contact();
  const double v_n = v.dot(c.n);
  const Vec3 v_t = tangent_part(v, c.n);
  const double a = std::sqrt(c.R_eff * c.overlap);
  const double S_n = 2.0 * material.Y_eff() * a;
  const double S_t = 8.0 * material.G_eff() * a;
  const bool clamped = material.damping == NormalDamping::clamped;

  const double F_elastic = 4.0 / 3.0 * material.Y_eff() * std::sqrt(c.R_eff) * std::pow(c.overlap, 1.5);
  const double gamma = clamped ? 2.0 * material.beta_clamped : 2.0 * std::sqrt(5.0 / 6.0) * material.beta();
  double F_n = F_elastic - gamma * std::sqrt(S_n * c.m_eff) * v_n;
  if (clamped && F_n < 0.0) F_n = 0.0;

  // The spring moves with the pair: spun about the normal, laid into the plane, as long as it was.
  Vec3 spring = memory.spring;
  if (spring.norm() > 0.0) {
    const double before = spring.norm();
    spring += dt * 0.5 * (i.w + j.w).dot(c.n) * c.n.cross(spring);
    spring = tangent_part(spring, c.n);
    if (spring.norm() > 0.0) spring *= before / spring.norm();
  }
  const double damping = 2.0 * std::sqrt(5.0 / 6.0) * material.beta() * std::sqrt(S_t * c.m_eff);
  const double limit = material.friction * std::abs(F_n);
  Vec3 F_t;
  if (material.history == TangentialHistory::force) {
    if (memory.radius > a) spring *= a / memory.radius;
    F_t = shortened_to(spring - S_t * v_t * dt - damping * v_t, limit);
    memory.spring = F_t + damping * v_t;
  } else {
    const Vec3 elastic = -S_t * (spring + v_t * dt);
    const bool slides = elastic.norm() > limit;
    F_t = slides ? shortened_to(elastic, limit) : shortened_to(elastic - damping * v_t, limit);
    memory.spring = (slides ? F_t : elastic) / -S_t;
  }
  memory.radius = a;

  PlainForces result;
  result.F_n = F_n;
  result.parts = F_elastic + (gamma * std::sqrt(S_n * c.m_eff) + damping + S_t * dt) * v.norm();
  result.force = F_n * c.n + F_t;
  result.torque = plain_rolling(material, c, i.w - j.w, F_elastic, F_n, dt, memory);
  return result;
}

}  // namespace repose::reference
