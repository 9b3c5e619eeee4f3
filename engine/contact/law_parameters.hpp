#pragma once

#include "engine/base/model.hpp"

namespace repose {

/// One side of a contact's material, elastic.
struct ElasticSide {
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson_ratio = 0.0;  ///< ν [-]
};

/// Everything of a contact law that is the same for all contacts of one kind (particle–particle or
/// particle–wall).
struct LawParameters {
  double young = 0.0;           ///< Y* [Pa]
  double shear = 0.0;           ///< G* [Pa]
  double normal_damping = 0.0;  ///< γ_n: F_d = −γ_n √(S_n m*) v_n [-]
  double tangent_damping = 0.0;  ///< γ_t: F_d = −γ_t √(S_n m*) v_t, γ_t = γ √(S_t/S_n), S_t/S_n = 4 G*/Y* [-]
  double friction = 0.0;         ///< μs [-]
  double rolling = 0.0;          ///< μr [-]
  double rolling_damping = 0.0;  ///< η_r, type_c [-]
  bool clamped = false;          ///< F_n ≥ 0 (NormalDamping::clamped)
  bool torque_limited = true;    ///< RollingTorque::limited
  TangentialHistory history = TangentialHistory::force;
};

/// Damping ratio of the law that keeps its tail: β = −ln e / √(ln² e + π²); 1 at e = 0, 0 at e = 1.
/// Source: Tsuji et al. 1992; Antypov & Elliott 2011.
double damping_ratio(double restitution);

/// Damping ratio β of the law clamped at Fn ≥ 0 with γ = 2 β, so that the rebound is e.
/// With x ~ δ^{5/4} and dτ ~ δ^{1/4} dt the damped Hertz impact is a linear oscillator of damping ratio
/// s = √(6/5) β (Antypov & Elliott 2011), and the clamp ends it where its force vanishes (Schwager & Pöschel
/// 2007):
///   s = sin a:   ln(1/e) = (π − 2a) tan a   for ln(1/e) ≤ 2;     s = cosh b:   ln(1/e) = 2 b coth b beyond.
/// The polynomial of Thornton, Cummins & Cleary 2013 is a fit to the same curve; it misses e by 0.3 % at 0.01
/// and by 1.5 % at 1, so the equation is solved. At e → 0 β grows without bound: e below 0.01 is taken as
/// 0.01.
double clamped_damping_ratio(double restitution);

/// Parameters of the contacts between materials a and b with restitution e, μs and μr.
///   Y = 2 G (1+ν),  1/Y* = Σ (1−ν²)/Y,  1/G* = Σ (2−ν)/G;   with the tail γ = 2 √(5/6) β, clamped γ = 2 β.
LawParameters law_parameters(const ElasticSide& a, const ElasticSide& b, double restitution,
                             double static_friction, double rolling_friction, double rolling_damping_ratio,
                             NormalDamping damping, TangentialHistory history);

}  // namespace repose
