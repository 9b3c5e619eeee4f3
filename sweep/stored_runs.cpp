#include "sweep/stored_runs.hpp"

#include "engine/run/run.hpp"

namespace repose::sweep {

StoredRuns::StoredRuns(std::vector<StoredRun> runs) : runs_(std::move(runs)) {
  for (std::size_t k = 0; k < runs_.size(); ++k) by_key_.emplace(runs_[k].run_key, k);
}

void StoredRuns::choose(const std::string& key, const StoredRun*& best) const {
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return;
  const StoredRun& run = runs_[found->second];
  if (best == nullptr || succeeds(run, *best)) best = &run;
}

const StoredRun* StoredRuns::find(const PlannedRun& planned) const {
  const StoredRun* best = nullptr;
  choose(planned.key, best);
  for (const std::string& key : planned.other_keys) choose(key, best);
  return best;
}

const StoredRun* StoredRuns::find(const Scene& scene, std::uint64_t seed) const {
  const StoredRun* best = nullptr;
  for (const std::string& key : run_keys(scene, seed)) choose(key, best);
  return best;
}

bool StoredRuns::is_done(const PlannedRun& planned) const {
  const StoredRun* run = find(planned);
  return run != nullptr && !run->failed();
}

}  // namespace repose::sweep
