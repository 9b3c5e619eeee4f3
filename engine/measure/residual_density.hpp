#pragma once

#include <vector>

namespace repose {

/// Density of the distances of tops from their lines, estimated from these distances themselves by a Gaussian
/// kernel; what the fit needs of it is its score.
class ResidualDensity {
 public:
  /// @param residuals distances e_i, at least one [m]
  /// @param weights   ≥ 0, at least one above zero
  /// @param bandwidth standard deviation of the kernel, > 0 [m]
  ResidualDensity(const std::vector<double>& residuals, const std::vector<double>& weights, double bandwidth);

  /// ψ(e) = −f′(e) / (f(e) + f₀) [1/m]; the floor f₀, 2 % of the density's peak, takes the influence of
  /// single tops far from the rest.
  [[nodiscard]] double score(double residual) const;

 private:
  double low_ = 0.0;
  double step_ = 0.0;
  std::vector<double> score_;  ///< at low_ + k step_
};

}  // namespace repose
