#pragma once

#include <filesystem>

#include "engine/scene/case_document.hpp"
#include "sweep/scheduler.hpp"

namespace repose::sweep {

/// All runs of a case's design that a folder does not hold yet: checks the whole design first, then makes
/// what is missing and stores each run as it ends. Called again after an interruption, or with a design that
/// was extended, it goes on with what is left; `failed` runs are tried again.
///
/// @param document  the case, with a /sweep (design_reader.hpp)
/// @param folder    of the study; made where there is none (study.hpp)
/// Throws InputError before anything runs (make_plan, open_or_create_study), and what run_all() throws.
SweepSummary run_sweep(const CaseDocument& document, const std::filesystem::path& folder,
                       const SweepOptions& options = {});

/// Where a study stands. All counts are of runs.
struct StudyStatus {
  int planned = 0;                               ///< of the design
  int done = 0;                                  ///< of those, stored with any outcome but `failed`
  int left = 0;                                  ///< of those, still to do: missing, or `failed`
  std::map<std::string, int> outcomes;           ///< of the planned runs that are stored
  std::map<std::string, WarningCount> warnings;  ///< of the same, by name
  int outside = 0;                               ///< stored, but not of the design as it now is
  int of_other_instructions = 0;  ///< of the planned runs that are stored, made for another instruction set
  std::vector<StoredRun>
      not_completed;  ///< planned runs that ended otherwise than `completed`, with their reasons
  std::optional<double> cpu_left_s;  ///< expected CPU time of what is left; nothing before the first run
};

/// Throws InputError as open_study() and make_plan() do.
StudyStatus status_of(const std::filesystem::path& folder);

/// Takes the runs of several studies of one case (its shards, say) into one folder. A folder that is new gets
/// the case of the first study; the design of the case in `into` is what counts there.
/// @return how many runs `into` then holds
/// Throws InputError, and takes nothing: a folder without a study, studies of different cases, a run of which
/// two studies hold different results (each named by its key).
int merge_studies(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& into);

}  // namespace repose::sweep
