#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stability/hostile/sample/hostile_case.hpp"

namespace repose::hostile {

struct SampleOptions {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< index of the first case
  int cases = 500;
  int reruns = 30;  ///< so many sound runs are repeated with a quarter of the step
  std::string root = ".";
  double longest = 120.0;  ///< wall-clock seconds after which a run is called hung
  std::function<void(int done)> on_progress;
};

struct SampleFault {
  std::uint64_t index = 0;
  std::string text;
};

/// A sound run and the same with a quarter of its step.
struct Rerun {
  std::uint64_t index = 0;
  double angle = 0.0, angle_of_quarter = 0.0;  ///< [rad]
  double error = 0.0;                          ///< of their difference, by their standard errors [rad]
  [[nodiscard]] double deviation() const { return (angle_of_quarter - angle) / error; }
};

struct SampleReport {
  /// By name, for each boldness of the cases; "refused" for those that are bad input.
  std::map<std::string, std::array<int, kBoldness.size()>> outcomes;
  std::map<std::string, int> warnings;  ///< of completed runs, by name
  int unquestioned = 0;                 ///< completed, and no warning of its motion
  double largest_imbalance = 0.0;       ///< of a completed run's ledger
  std::vector<SampleFault> faults;
  std::vector<Rerun> reruns;
  /// Sound runs that had no angle with a quarter of the step: near the bar of a heap, of its error or of the
  /// time.
  std::map<std::string, int> reruns_without_angle;
  double cpu = 0.0, slowest = 0.0;  ///< CPU time of all runs and of the slowest [s]
  std::uint64_t slowest_index = 0;

  /// Mean of the angles' differences, quarter step less the step, and its standard error from their scatter
  /// [rad].
  [[nodiscard]] double mean_difference() const;
  [[nodiscard]] double error_of_mean_difference() const;
};

/// Runs the cases of a sample one after the other and looks at each; an angle that changes with a quarter of
/// the step by more than kMostDeviations of its error, or by more than three standard errors in the mean, is
/// a fault too.
SampleReport run_sample(const SampleOptions& options);
inline constexpr double kMostDeviations = 5.0;

}  // namespace repose::hostile
