#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/case_document.hpp"
#include "engine/scene/scene.hpp"
#include "sweep/design.hpp"
#include "sweep/stored_run.hpp"

namespace repose::sweep {

struct PlannedPoint {
  std::vector<double> values;  ///< in the order of Design::factors
  Scene scene;
  std::size_t rung = 0;  ///< of a chart's ladder (DesignPoint)
};

struct PlannedRun {
  std::size_t point = 0;  ///< index into Plan::points
  int replicate = 1;
  std::uint64_t seed = 0;
  std::string key;
  std::vector<std::string> other_keys;  ///< of the same run by builds for other instruction sets (run_keys)
};

/// Every run of a case's design, point by point, with the scene of each point read and checked.
struct Plan {
  Design design;
  std::vector<PlannedPoint> points;
  std::vector<PlannedRun> runs;

  [[nodiscard]] FactorValues factors_of(std::size_t point) const;
  /// The rung's name of a chart's point, "reference" for the reference; "" in every other design.
  [[nodiscard]] std::string variant_of(std::size_t point) const;
};

/// Reads a case's design and the scene at each of its points. Throws InputError with every fault: those of
/// /sweep (read_design), of a table, and each that the scene has at some point; a value that the scene
/// refuses is named at its factor, once however many points have it.
Plan make_plan(const CaseDocument& document);

/// Part `index` of `count` equal parts of a plan.
struct Shard {
  int index = 1;  ///< 1 … count
  int count = 1;
};

/// "2/4". Throws InputError unless 1 ≤ index ≤ count.
Shard parse_shard(const std::string& text);

/// Indices into Plan::runs that belong to a shard. The runs are dealt out in an order that is shuffled by a
/// hash of point and replicate, so that every shard gets its part of each factor's range; the hash knows
/// nothing of the machine. Shards are disjoint, together they are the whole, and their sizes differ by at
/// most one.
std::vector<std::size_t> runs_of_shard(const Plan& plan, const Shard& shard);

}  // namespace repose::sweep
