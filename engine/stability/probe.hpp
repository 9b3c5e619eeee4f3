#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "engine/dynamics/simulation.hpp"
#include "engine/slump/motion_watch.hpp"

namespace repose {

/// What went wrong at a step.
enum class Failure {
  none,         ///< the step is stable
  energy,       ///< the ledger does not close
  overlap,      ///< contacts deeper than the sound motion's
  escaped,      ///< bodies through a wall
  diverged,     ///< numbers that are not finite, or places out of all bounds
  interrupted,  ///< stopped: says nothing
};
/// "energy", "overlap", …; "none".
const char* name_of(Failure failure);

/// One experiment at one step.
struct Probe {
  double step = 0.0;          ///< Δt [s]
  double energy_error = 0.0;  ///< the ledger's imbalance farthest from 0, over the experiment's energy [-]
  double overlap = 0.0;       ///< deepest overlap over the sound motion's [-]
  Failure failure = Failure::none;

  [[nodiscard]] bool stable() const { return failure == Failure::none; }
};

/// An experiment: a step in, what happened out. Equal steps give equal bits.
using Experiment = std::function<Probe(double step)>;

/// What a motion may do and still counts as stable.
struct Tolerance {
  /// Imbalance of the ledger over the experiment's energy [-]; the default is what ends a run `unstable`.
  double energy = MotionDiagnosis::kMostImbalance;
  double overlap = 0.25;  ///< by which overlaps may be deeper than the sound motion's [-]
};

/// A simulation looked at while it runs.
struct Watched {
  double duration = 0.0;       ///< [s]
  double look_interval = 0.0;  ///< [s]; at least a step
  double energy = 0.0;         ///< what the imbalance is compared with [J]
  double overlap = 0.0;        ///< the sound motion's deepest overlap over the smaller radius [-]
  Tolerance tolerance;
  const std::atomic<bool>* stop = nullptr;
};

/// Steps until the duration is over or something went wrong; a ledger that is off ends it early only beyond
/// kHopeless, so that the curve of errors shows the cliff.
Probe watch_steps(Simulation& simulation, const Watched& watched);
inline constexpr double kHopeless = 10.0;

/// What a probe's numbers mean.
Failure judge(const Probe& probe, const Tolerance& tolerance);

}  // namespace repose
