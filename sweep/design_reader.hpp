#pragma once

#include "engine/base/input_error.hpp"
#include "engine/scene/case_document.hpp"
#include "sweep/design.hpp"

namespace repose::sweep {

/// Most runs of a design; more are taken for a slip of the pen.
inline constexpr double kMostRuns = 1e6;

/// Reads /sweep of a case:
///
///     "design": "full_factorial" | "latin_hypercube" | "sobol" | "table" | "chart"
///     "factors": {"mu_s": [0.2, 0.5, 0.8]}   every value (full_factorial), or [low, high] (the next two)
///     "runs": 64                             points of latin_hypercube and sobol
///     "table": "points.csv"                  table: a column for each factor, and "replicate" if wanted
///     "replicates": 3, "seed": 1             defaults 1 and 1
///     "common_random_numbers": false         see seed_of()
///     "scramble": false                      sobol, see points_of()
///
/// A chart takes nothing else: all that it is stands at /chart (ladder.hpp).
///
/// @param faults  takes every fault found; the design returned is of use only if none was added
Design read_design(const CaseDocument& document, Faults& faults);

}  // namespace repose::sweep
