#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/power_law.hpp"
#include "fit/response_table.hpp"

namespace repose::fit {

/// A measured angle and what is known besides.
struct Question {
  double angle = 0.0;                      ///< α measured [deg]
  double sigma = 0.0;                      ///< its standard error [deg], ≥ 0
  std::optional<double> e = std::nullopt;  ///< known values of the factors, where there are any
  std::optional<double> mu_s = std::nullopt;
  std::optional<double> mu_r = std::nullopt;
  int curve_points = 41;  ///< of the level set, ≥ 2
};

/// A point of the curve of (μs, μr) that give the angle, with its 95 % band: how far μs may lie from it at
/// this μr, and μr at this μs. Bands end at the edge of the domain.
struct LevelPoint {
  double mu_s = 0.0;
  double mu_r = 0.0;
  Range mu_s_band;
  Range mu_r_band;
};

/// The μs that agree with the angle at a μr, to 95 %, within the domain; for drawing the band as an area.
struct BandRow {
  double mu_r = 0.0;
  Range mu_s;
};

/// The friction values that one question leaves.
struct Solution {
  Factors value;
  Factors low;               ///< 95 % interval of the factor solved for, the value itself for those fixed
  Factors high;              ///< likewise
  bool solved_mu_s = false;  ///< else μr
  bool reaches_the_edge = false;  ///< the interval is cut by the domain
};

/// Everything that an equation and an angle say about friction.
struct Inversion {
  Question question;
  double e = 0.0;                     ///< at which the curve is drawn
  bool e_is_given = false;            ///< else the geometric mean of the domain
  double restitution_effect = 0.0;    ///< change of the angle from the lowest to the highest e swept [deg]
  Range reachable;                    ///< angles that the equation gives over the domain at this e [deg]
  std::vector<LevelPoint> level_set;  ///< by rising μs (μr where μs stands still)
  std::vector<BandRow> band;          ///< by rising μr; empty where only one of the two varies
  std::optional<Solution> solution;   ///< where enough is fixed
  bool identifiable = false;  ///< the solution exists and the angle does depend on what was solved for
  std::string remark;         ///< what the bands leave out, in a sentence; mostly empty
};

/// Inverts α = C e^a μr^b μs^c.
///
/// The level set is b ln μr + c ln μs = ln(α / (C e^a)), a straight line in logarithms, clipped to the domain
/// that the fit covers; e is the given one or the geometric mean of its domain. With one of μs, μr given (or
/// not varied in the table) the other is solved for.
///
/// Bands are those of inverse regression (Fieller): every value x at which the equation agrees with the
/// angle,
///   |ln α(x) − ln α|² ≤ t² (h(x)ᵀ Σ h(x) + s²/α²) + z² σ²/α²,
/// Σ the covariance of the parameters, s the scatter of simulated angles about the law, σ that of the
/// measured one, t the 97.5 % point of Student's law with the fit's degrees of freedom and z that of the
/// normal law: σ is known, and a larger one never narrows the band. (One t for both, with the degrees of
/// Welch and Satterthwaite, held in 88 to 94 of 100 at 1 to 3 degrees, and narrowed it.)
///
/// Throws Unusable: an angle that is not in (0, 90), a negative σ, a given value outside the domain (which is
/// named), both frictions given, or an equation without either friction or with exponents of 0. Throws
/// Unreachable, with the range that can be reached, for an angle outside it.
Inversion invert(const PowerLaw& law, const Question& question);

/// What is wrong with a question whatever the equation over a domain, each fault in words: what invert() says
/// of it before it knows of the angle's reach. A factor whose range is one value does not vary.
std::vector<std::string> faults_of(const Domain& domain, const Question& question);

}  // namespace repose::fit
