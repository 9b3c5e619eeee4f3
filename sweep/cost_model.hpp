#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/scene/scene.hpp"

namespace repose::sweep {

/// Rough number of sphere updates of a slump test, to compare tests with each other before any has run:
///   W = N n T / Δt,   N = M / (ρ V̄),   T = M / pour rate (if poured) + 1 s,   Δt = fraction · T_R or as
///   given, T_R = π R √(ρ/G) / (0.163 ν + 0.8766) with R the smallest sphere's radius,
/// where n is the mean number of spheres of a body. "auto" counts as a fraction of 0.3.
/// @return W > 0, not finite only for a scene that cannot be run
/// Source: Li et al. 2017 eq. 9 for T_R.
double estimated_work(const Scene& scene);

/// CPU seconds of runs: guessed from their estimated work, and better with every run that was measured.
/// A point that has been measured counts with its own mean; any other with its work times the mean seconds
/// per unit of work of all that was measured.
class CostModel {
 public:
  explicit CostModel(std::vector<double> work_of_points);

  void learn(std::size_t point, double cpu_seconds);
  /// Expected CPU time of a run of a point [s]; nothing before the first measurement.
  [[nodiscard]] std::optional<double> seconds(std::size_t point) const;
  /// The same in units that only compare points with each other: seconds, or the work as long as nothing was
  /// measured.
  [[nodiscard]] double weight(std::size_t point) const;

 private:
  struct Measured {
    double seconds = 0.0;
    int runs = 0;
  };
  std::vector<double> work_;
  std::vector<Measured> measured_;
  double total_seconds_ = 0.0;
  double total_work_ = 0.0;
};

}  // namespace repose::sweep
