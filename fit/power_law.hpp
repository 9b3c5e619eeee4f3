#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/errors.hpp"
#include "fit/response_table.hpp"

namespace repose::fit {

/// What a fit makes smallest: the sum of squared errors, or the worst error (both in degrees).
enum class Loss { least_squares, minimax };
/// "least-squares", "minimax"
const char* name_of(Loss loss);
/// Throws Unusable for any other name.
Loss loss_named(const std::string& name);

/// What a table covers: smallest and largest value over the points that were fitted.
struct Domain {
  Range e, mu_s, mu_r;
  Range angle;  ///< observed [deg]
};

/// One parameter of the law.
struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;  ///< NaN if not identified
  Range interval_95;            ///< value ± t(0.975, degrees of freedom) × standard error; NaN likewise
  bool identified = false;      ///< false: the factor does not vary, the exponent is 0 and C holds its effect
};

/// What turns the law of a cheap test into that of its reference: α_ref = α_cheap C' e^a' μr^b' μs^c'.
struct Correction {
  Estimate C, a, b, c;  ///< exponents that were not taken are 0 and not identified
  int cheap_rows = 0;
  int reference_rows = 0;
};

/// A row that the law cannot take.
struct Excluded {
  Observation observation;
  std::string reason;
};

/// How the scatter about the law was judged.
struct ErrorModel {
  double standard_deviation = 0.0;  ///< of one angle about the law, √(τ² + σ²) [deg]
  double misfit = 0.0;              ///< τ, of the law at a point, which all its repeats share [deg]
  double degrees_of_freedom = 0.0;
  /// σ², of a row alone [deg²].
  [[nodiscard]] double own_variance() const {
    return std::max(0.0, standard_deviation * standard_deviation - misfit * misfit);
  }
  /// Scatter of repeats about their own mean [deg]; NaN without repeats.
  double pure_error = std::numeric_limits<double>::quiet_NaN();
  /// P of a lack of fit this large if the law were right (F test); NaN without repeats.
  double lack_of_fit_p = std::numeric_limits<double>::quiet_NaN();
};

/// α = C e^a μr^b μs^c, α in degrees, with what is known about it.
struct PowerLaw {
  Loss loss = Loss::least_squares;
  Estimate C, a, b, c;
  /// Of (ln C, a, b, c); rows and columns of parameters that are not identified are 0.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  ErrorModel error;
  double worst_error = 0.0;  ///< largest |predicted − observed| [deg]
  Observation worst_point;   ///< where
  double rms_error = 0.0;    ///< √(Σ(predicted − observed)²/n) [deg]
  double r_squared = 0.0;  ///< 1 − Σ(predicted − observed)²/Σ(observed − mean)²; NaN if all angles are equal
  int points = 0;           ///< fitted
  int distinct_points = 0;  ///< of them with factors of their own
  std::vector<Excluded> excluded;
  /// Where some rows are of a cheap test. The law, its errors and its worst point are then those of the
  /// reference.
  std::optional<Correction> correction;
  std::vector<std::string> remarks;  ///< what a reader has to know, in sentences
  Domain domain;

  /// α [deg] at the factors. Those without an identified exponent do not matter.
  [[nodiscard]] double predict(const Factors& factors) const;
  /// h with ln α = h·(ln C, a, b, c): (1, ln e, ln μr, ln μs), 0 for exponents that are not identified.
  [[nodiscard]] Eigen::Vector4d log_row(const Factors& factors) const;
  /// Standard error of the mean angle at the factors, from the covariance [deg].
  [[nodiscard]] double standard_error_at(const Factors& factors) const;
  /// Of (C, a, b, c); NaN where a parameter is not identified.
  [[nodiscard]] Eigen::Matrix4d correlation() const;
  /// In the order C, a, b, c.
  [[nodiscard]] std::array<const Estimate*, 4> parameters() const { return {&C, &a, &b, &c}; }
};

/// Fits the law in degrees of angle.
///
/// A row is left out, with its reason, if the caller says so (Observation::exclusion), if a number in it is
/// not finite, if its angle is not between 0 and 90 degrees, if a factor is negative or e above 1, or if a
/// factor that varies is 0 there (the law is 0 or infinite). A factor that does not vary has no exponent to
/// find: it is 0 and `identified` is false.
///
/// Standard errors, least squares: an angle misses the law by τ at its factors, which all repeats there
/// share, and by σ of its own, so that
///   Cov θ = (JᵀJ)⁻¹ (σ² JᵀJ + τ² Σ_p s_p s_pᵀ) (JᵀJ)⁻¹,   s_p = Σ over the rows at the factors p of J's
///   rows.
/// Repeats are no witnesses of the law: with ten a point instead of one σ²/10 is left beside τ². σ² is the
/// mean square of repeats about their means and τ² what the lack of fit has beyond it (method of moments),
/// with the degrees of freedom of the lack of fit (points − parameters); unless an F test finds no lack of
/// fit at the 25 % level that Bancroft (1964) advises for pooling: then τ = 0 and σ² is that of all rows
/// (rows − parameters). Without repeats likewise. Minimax has no such theory: its covariance is that of 200
/// refits to angles that are drawn anew by the same two (a parametric bootstrap with a fixed seed).
///
/// Where some rows are of a cheap test (Observation::cheap), both tests are fitted together and the law
/// returned is that of the others (two_fidelities.hpp); by least squares only.
///
/// Throws Unusable: no usable row, not more distinct points than parameters, factors that only vary together,
/// no convergence.
PowerLaw fit_power_law(std::span<const Observation> table, Loss loss = Loss::least_squares);

}  // namespace repose::fit
