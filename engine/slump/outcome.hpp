#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/crew.hpp"
#include "engine/scene/heap_snapshot.hpp"

namespace repose {

class ColumnShelf;

/// How a slump test ended. Only `completed` carries an angle that may enter a fit.
enum class Outcome {
  completed,
  no_heap,      ///< nothing lies on the base that has a slope
  unreadable,   ///< something lies there, but its angle cannot be told
  timed_out,    ///< no rest within the time of a stage
  too_long,     ///< more steps than a run may take
  overfull,     ///< the particles do not fit into the cylinder
  overlapping,  ///< contacts so deep that what is packed are no longer these particles
  escaped,      ///< bodies went through a wall
  unstable,     ///< energy from nowhere
  diverged,     ///< numbers that are not finite, or places out of all bounds
  interrupted
};
/// "completed", "no_heap", …
const char* name_of(Outcome outcome);

/// What a run shows while it is under way.
struct Progress {
  std::string stage;          ///< pour, settle, open, rest
  double time = 0.0;          ///< simulated [s]
  double energy_ratio = 0.0;  ///< mean kinetic energy per body over m g d [-]
  long steps = 0;
  int bodies = 0;                    ///< now in the simulation
  double expected_mass_share = 0.0;  ///< share of the mass poured so far, 0 … 1
};

struct RunOptions {
  std::function<void(const Progress&)> on_progress;  ///< called about every 10 ms of simulated time
  std::function<void(const HeapSnapshot&)>
      on_frame;                             ///< called every frame_interval of simulated time, if > 0
  double frame_interval = 0.0;              ///< [s]
  const std::atomic<bool>* stop = nullptr;  ///< set: the run ends `interrupted` soon
  /// Threads that help, led by the caller; without one it works alone. The result is the same to the last
  /// bit.
  std::shared_ptr<Crew> crew;
  /// Where shared columns are kept for other runs; without one a run makes its own. The result is the same.
  std::shared_ptr<ColumnShelf> columns;
};

}  // namespace repose
