#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "chart/choice.hpp"
#include "chart/comparison.hpp"
#include "sweep/plan.hpp"

namespace repose::chart {

/// A ladder whose runs are read and compared. While runs are missing it is the chart of the replicates that
/// the reference has, and of the rungs that have all runs that belong to those.
struct Chart {
  CaseDocument document;  ///< of the study; paths in it are relative to its folder
  std::string title;
  std::vector<std::string> frictions;          ///< "mu_r = 0.05, mu_s = 0.2"
  int replicates = 0;                          ///< of the reference with a set
  int rung_replicates = 0;                     ///< of a rung with a set
  int missing_runs = 0;                        ///< of the ladder
  std::set<std::string> engines;               ///< that made its runs, with their instruction sets
  std::vector<std::string> unfinished;         ///< rungs left out because they lack runs
  sweep::Variant reference_variant;            ///< as the study has it
  std::vector<sweep::Variant> variants;        ///< of the rungs
  std::vector<sweep::Override> working_point;  ///< what it sets; empty where there is none
  /// Of the reference: the mean angle of each set of frictions, empty where a run did not complete.
  std::vector<Estimate> reference_angle;
  std::map<std::string, int> reference_outcomes;
  std::string reference_failure;         ///< reason of its first run that did not complete, or empty
  double reference_cpu = 0.0;            ///< mean of a run [s]
  double scatter = 0.0;                  ///< of the reference's angle from run to run [degrees]
  std::vector<Comparison> rungs;         ///< in the order of the ladder, without the unfinished
  std::vector<Differences> differences;  ///< of their angles; empty where a run did not complete

  [[nodiscard]] bool has_reference() const { return !reference_angle.empty(); }
};

/// Reads the runs of a chart from the folder of its study, complete or not; it has a reference from two
/// replicates on. Throws InputError as open_study() and make_plan() do.
Chart read_chart(const std::filesystem::path& folder);

/// What a rung or the reference sets, with paths that can be found from anywhere.
sweep::Variant anywhere(sweep::Variant variant, const Chart& chart);

/// What the rungs stand on, if it completed; std::nullopt: the reference.
std::optional<Candidate> working_point_of(const Chart& chart);

/// The rungs that a combination may be made of: completed and cheaper than the reference; on a working point
/// cheaper than that, or with a smaller bound of the error.
std::vector<Candidate> candidates_of(const Chart& chart);

/// A combination as a rung of its own, with paths that can be found from anywhere.
sweep::Variant variant_of(const Combination& combination, const std::vector<Candidate>& candidates,
                          const Chart& chart);

}  // namespace repose::chart
