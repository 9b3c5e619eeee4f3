#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "engine/scene/scene.hpp"
#include "sweep/plan.hpp"
#include "sweep/stored_run.hpp"

namespace repose::sweep {

/// The runs of a study, to be found again by what was planned. A run that a build of the same engine for
/// another instruction set has made is as good as one of this machine: only its rounding differs, and with it
/// what grains, which are chaotic, make of that; the law of the angles is the same.
class StoredRuns {
 public:
  explicit StoredRuns(std::vector<StoredRun> runs);

  /// The run of this scene and seed; of several the one that stands (succeeds()); null if there is none.
  [[nodiscard]] const StoredRun* find(const PlannedRun& planned) const;
  [[nodiscard]] const StoredRun* find(const Scene& scene, std::uint64_t seed) const;
  /// Whether it is there and is not to be tried again (`failed`).
  [[nodiscard]] bool is_done(const PlannedRun& planned) const;

  [[nodiscard]] const std::vector<StoredRun>& all() const { return runs_; }

 private:
  void choose(const std::string& key, const StoredRun*& best) const;

  std::vector<StoredRun> runs_;
  std::unordered_map<std::string, std::size_t> by_key_;
};

}  // namespace repose::sweep
