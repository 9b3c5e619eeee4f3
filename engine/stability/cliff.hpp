#pragma once

#include <vector>

#include "engine/stability/probe.hpp"

namespace repose {

/// How finely the largest stable step is looked for.
struct CliffSearch {
  double start = 0.0;       ///< first step tried [s]
  double precision = 0.05;  ///< largest stable and smallest unstable step differ by at most this share [-]
};

/// Between which steps an experiment loses its stability.
struct Cliff {
  double stable = 0.0;              ///< largest step found stable below the first unstable one [s]; 0: none
  double unstable = 0.0;            ///< smallest step found unstable above it [s]; 0: none
  Failure failure = Failure::none;  ///< what goes wrong at `unstable`
  std::vector<Probe> probes;        ///< every step tried, ascending
  bool interrupted = false;

  /// The probe at `stable`, or nullptr.
  [[nodiscard]] const Probe* last_stable() const;
};

/// Walks from the first step by factors of kWalk: upwards until a step is unstable where the first is stable,
/// at most kLongestWalkUp times; downwards until one is stable where it is not, at most kLongestWalkDown
/// times, a thirty-second, because small steps cost. Then bisects the factor between the two. Where stability
/// comes and goes, the lowest cliff above the first step is found as long as it is wider than kWalk. A few
/// more steps on both sides, a fourth to twice the cliff, show how the error rises; they do not move it.
Cliff find_cliff(const Experiment& experiment, const CliffSearch& search);
inline constexpr double kWalk = 1.4142135623730951;
inline constexpr int kLongestWalkUp = 20, kLongestWalkDown = 10;

}  // namespace repose
