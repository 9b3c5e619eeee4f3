#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/input_error.hpp"
#include "engine/scene/case_document.hpp"

namespace repose::sweep {

/// One value that a rung sets in the case.
struct Override {
  std::string pointer;  ///< of the case
  CaseDocument::Json value;
  std::string place;  ///< pointer to where the case says so
};

/// The case with some values of its own.
struct Variant {
  std::string name;
  std::vector<Override> set;
  std::size_t shared = 0;  ///< how many of them, the first, are the working point's

  /// What it sets itself; of the working point nothing.
  [[nodiscard]] std::span<const Override> own() const { return std::span(set).subspan(shared); }
};

/// What /chart of a case says, checked: simplifications that are compared with a reference.
struct Ladder {
  Variant reference;  ///< the case itself where it sets nothing
  /// Each is set on top of the reference. Where there is a working point it is the first, and the others
  /// stand on it.
  std::vector<Variant> rungs;
  bool has_working_point = false;
  std::vector<std::string> friction_names;
  std::vector<std::vector<double>> frictions;  ///< one entry a set, in the order of the names
  int replicates = 5;                          ///< runs of the reference with a set
  int rung_replicates = 5;                     ///< of a rung with a set: `replicates` or a multiple of it
  std::uint64_t seed = 1;

  /// @param rung  0: the reference
  [[nodiscard]] int replicates_of(std::size_t rung) const { return rung == 0 ? replicates : rung_replicates; }
};

/// Name of the reference among the variants.
inline constexpr const char* kReference = "reference";
/// Name of the working point among the rungs.
inline constexpr const char* kWorkingPoint = "working point";

/// Origin of what a default ladder fills in. Its list of rungs is empty where the case cannot be read, whose
/// faults say more than that the list is empty.
inline constexpr const char* kDefaultLadder = "the default ladder";

/// What a working point sets, then what stands on it: of the working point's all that this does not replace,
/// by the same pointer, one above it or its rival (rival_keys()).
Variant on_working_point(std::span<const Override> working_point, Variant variant);

/// Reads /chart of a case:
///
///     "reference": {"/numerics/time_step_fraction": 0.1}        may be left out
///     "working_point": {"/numerics/stiffness_scale": 0.001}     may be left out: then the reference
///     "rungs": [{"name": "soft", "set": {"/numerics/stiffness_scale": 0.01}}, …]
///     "frictions": [{"mu_s": 0.2, "mu_r": 0.05}, …]             all of the same factors
///     "replicates": 5, "rung_replicates": 5, "seed": 1          these are the defaults
///
/// Without "rung_replicates" rungs are run as often as the reference.
///
/// @param faults  takes every fault found; the ladder returned is of use only if none was added
Ladder read_ladder(const CaseDocument& document, Faults& faults);

/// Pointers to every path of a shape's file in a case, those of its ladder as well.
std::vector<std::string> shape_paths(const CaseDocument& document);

/// The value of an override with its paths made absolute, so that it may be set in any document.
CaseDocument::Json with_absolute_paths(const CaseDocument& document, const Override& override);

}  // namespace repose::sweep
