#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/run.hpp"
#include "sweep/cost_model.hpp"
#include "sweep/plan.hpp"
#include "sweep/store.hpp"

namespace repose::sweep {

/// How one test is made; replaced in the tests of this folder.
using Run = std::function<RunResult(const Scene&, std::uint64_t seed, const RunOptions&)>;

/// Where a sweep stands. All counts are of runs.
struct SweepProgress {
  int planned = 0;  ///< in this call's part of the design
  int done = 0;     ///< stored, by this call or before
  int failed = 0;   ///< of those done: ended otherwise than `completed`
  int running = 0;
  int left = 0;                 ///< not done, with those that are running
  double elapsed_s = 0.0;       ///< of this call
  std::optional<double> eta_s;  ///< to the end; nothing before the first run is measured
};

struct SweepOptions {
  int threads = 0;  ///< runs at a time, until fewer are left; 0: one a processor
  Shard shard;
  /// Set (by a signal handler, say): no run is started any more, runs under way end `interrupted` and are not
  /// stored.
  const std::atomic<bool>* stop = nullptr;
  /// Called when a run starts or ends and about once a second between, one call at a time, from any thread.
  std::function<void(const SweepProgress&)> on_progress;
  /// Called for each run once it is stored, one call at a time, from any thread. The result is empty but for
  /// seed and key where the run failed by an exception.
  std::function<void(const StoredRun&, const RunResult&)> on_finished;
  Run run = run_slump_test;
};

/// What one call did.
struct SweepSummary {
  int planned = 0;                               ///< in this call's part of the design
  int present = 0;                               ///< stored before
  int finished = 0;                              ///< stored by this call
  int left = 0;                                  ///< neither
  std::map<std::string, int> outcomes;           ///< of all planned runs that are stored
  std::map<std::string, WarningCount> warnings;  ///< of the same, by name
  bool interrupted = false;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< of the runs of this call
};

/// Makes runs of a plan in parallel, one thread a run, and stores each as it ends: replicate by replicate, so
/// that what is there early spans the design, and of a replicate the longest first. Threads that find no run
/// left help those under way. What is stored does not depend on threads, order or interruptions. A run that
/// throws is stored as `failed` and the others go on.
/// @param todo   indices into plan.runs
/// @param costs  learns from each run
/// @param begin  planned, present (as done) and failed of the part of the design that todo belongs to
/// @return finished, interrupted, wall_s, cpu_s
/// Throws, after the runs under way have ended: SqliteError where the store cannot be written (a full disk),
/// std::runtime_error where a run's result differs from one that is stored for its key, whatever a callback
/// threw.
SweepSummary run_all(const Plan& plan, const std::vector<std::size_t>& todo, Store& store, CostModel& costs,
                     const SweepProgress& begin, const SweepOptions& options);

}  // namespace repose::sweep
