#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/scene/scene.hpp"

namespace repose::sweep {

/// Rough cost of a slump test, to compare tests with each other before any has run:
///   W = N √n T (1/Δt + 200 v/d),   N = M / (ρ V̄),   T = M / pour rate (if poured) + 1 s,
/// with the mean number n of spheres of a body, the speed v of a fall through the cylinder and the diameter d
/// of a sphere of the mean volume V̄. The steps cost 1/Δt; neighbours change places v/d times a second, which
/// costs the searches for them. √n and the 200 are fitted to 3 kg of ore at 15 to 40 µs: clumps of 8 to 60
/// spheres and 0.01 or 0.001 of the stiffness, 30 to 116 s a run, are told within 10 %.
/// @return W > 0, not finite only for a scene that cannot be run
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
