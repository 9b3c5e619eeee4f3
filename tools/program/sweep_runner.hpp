#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "sweep/sweep.hpp"
#include "tools/program/command.hpp"

namespace repose::program {

/// A case's design on its way into a folder.
struct SweepRequest {
  std::filesystem::path case_file;
  std::filesystem::path folder;
  std::optional<int> threads;  ///< one a core where not given
  std::string shard;           ///< "2/4", or empty
  bool quiet = false;
  /// Makes another case of the one that was read, before anything is checked; nothing: the case as it is.
  std::function<CaseDocument(const CaseDocument&)> prepare = nullptr;
  /// Called for each run once it is stored (sweep::SweepOptions).
  std::function<void(const sweep::StoredRun&, const RunResult&)> on_finished = nullptr;
};

/// Makes every run that the folder does not hold yet, with progress on standard error; Ctrl-C ends it in
/// order. Throws InputError with every fault, the caller's as well, before the folder is touched.
sweep::SweepSummary sweep_case(const SweepRequest& request, Faults faults = {});

/// 0; 130 if interrupted; 3 if a run of the design ended otherwise than `completed`.
int exit_code_of(const sweep::SweepSummary& summary);

/// "36 of 36 runs done (35 completed, 1 no_heap), 30 of them now in 4 min 10 s".
std::string in_words(const sweep::SweepSummary& summary);
nlohmann::ordered_json to_json(const sweep::SweepSummary& summary);

/// "35 completed, 1 no_heap".
std::string in_words(const std::map<std::string, int>& outcomes);

/// "4 × few_particles: the heap holds …", one warning a line.
std::string in_words(const std::map<std::string, sweep::WarningCount>& warnings);
/// {"few_particles": {"runs": 4, "example": "the heap holds …"}}
nlohmann::ordered_json warnings_json(const std::map<std::string, sweep::WarningCount>& warnings);

}  // namespace repose::program
