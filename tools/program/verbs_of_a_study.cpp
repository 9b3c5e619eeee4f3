#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "sweep/export.hpp"
#include "sweep/study.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"
#include "tools/program/sweep_runner.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace fs = std::filesystem;

namespace {

// status
// ---------------------------------------------------------------------------------------------------------

struct StatusOptions {
  CommonOptions common;
  fs::path folder;
};

/// Time on every core of this machine [s].
std::optional<double> time_left(const sweep::StudyStatus& status) {
  if (!status.cpu_left_s) return std::nullopt;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return *status.cpu_left_s / std::max(1, std::min(cores, status.left));
}

nlohmann::ordered_json to_json(const sweep::StudyStatus& status) {
  nlohmann::ordered_json json = {{"planned", status.planned},
                                 {"done", status.done},
                                 {"failed", status.not_completed.size()},
                                 {"left", status.left},
                                 {"outcomes", status.outcomes},
                                 {"outside_the_design", status.outside},
                                 {"of_other_instructions", status.of_other_instructions}};
  json["cpu_left_s"] = status.cpu_left_s ? nlohmann::ordered_json(*status.cpu_left_s) : nullptr;
  const auto left = time_left(status);
  json["time_left_s"] = left ? nlohmann::ordered_json(*left) : nullptr;
  json["warnings"] = warnings_json(status.warnings);
  json["not_completed"] = nlohmann::ordered_json::array();
  for (const sweep::StoredRun& run : status.not_completed)
    json["not_completed"].push_back({{"run_key", run.run_key},
                                     {"factors", run.factors},
                                     {"replicate", run.replicate},
                                     {"seed", run.seed},
                                     {"outcome", run.outcome},
                                     {"reason", run.reason}});
  return json;
}

std::string factors_in_words(const sweep::FactorValues& factors) {
  std::string text;
  for (const auto& [name, value] : factors)
    text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", name, value);
  return text;
}

int status_verb(const StatusOptions& options) {
  const sweep::StudyStatus status = sweep::status_of(options.folder);
  if (options.common.json) {
    print_json(to_json(status));
    return kDone;
  }
  fmt::print("{} of {} runs done", status.done, status.planned);
  if (!status.outcomes.empty()) fmt::print(" ({})", in_words(status.outcomes));
  fmt::print(", {} left", status.left);
  if (const auto left = time_left(status); left && status.left > 0)
    fmt::print(", about {} on this machine", duration_text(*left));
  fmt::print("\n");
  if (status.of_other_instructions > 0)
    fmt::print("{} of them on processors with other instructions: the same test, rounded otherwise\n",
               status.of_other_instructions);
  if (status.outside > 0) fmt::print("{} more that the design does not have any more\n", status.outside);
  for (const sweep::StoredRun& run : status.not_completed)
    fmt::print("  {} (replicate {}): {}: {}\n", factors_in_words(run.factors), run.replicate, run.outcome,
               run.reason);
  if (!status.warnings.empty()) fmt::print("warnings:\n{}", in_words(status.warnings));
  return kDone;
}

// export
// ---------------------------------------------------------------------------------------------------------

struct ExportOptions {
  CommonOptions common;
  fs::path folder;
  fs::path file;
};

/// Whether a file is one of those that make up a study.
bool is_of_study(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  return fs::equivalent(file, folder / sweep::kStudyFile, error) ||
         fs::equivalent(file, folder / sweep::kCaseFile, error);
}

int export_verb(const ExportOptions& options) {
  Faults faults;
  check_output_file(faults, options.file);
  if (is_of_study(options.file, options.folder))
    faults.add("--csv", "", options.file.string(), "is a file of the study itself");
  try {
    sweep::open_study(options.folder);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  sweep::export_csv(options.folder, options.file);
  if (options.common.json)
    print_json({{"file", options.file.string()}});
  else if (!options.common.quiet)
    fmt::print("written to {}\n", options.file.string());
  return kDone;
}

// merge
// ----------------------------------------------------------------------------------------------------------

struct MergeOptions {
  CommonOptions common;
  std::vector<fs::path> folders;
  fs::path into;
};

int merge_verb(const MergeOptions& options) {
  Faults faults;
  check_folder(faults, options.into);
  faults.throw_if_any();
  const int runs = sweep::merge_studies(options.folders, options.into);
  if (options.common.json)
    print_json({{"into", options.into.string()}, {"runs", runs}});
  else if (!options.common.quiet)
    fmt::print("{} holds {} runs\n", options.into.string(), runs);
  return kDone;
}

}  // namespace

void add_status(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options =
      add_verb(app, chosen, "status", "What of a study is done, failed and left, and how long it will take",
               status_verb, verb);
  verb->add_option("DIR", options.folder, "Folder of the study")->required();
}

void add_export(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "export", "The runs of a study as a table", export_verb, verb);
  verb->add_option("DIR", options.folder, "Folder of the study")->required();
  verb->add_option("--csv", options.file, "File to write")->required();
}

void add_merge(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "merge", "The runs of several studies of one case in one folder",
                           merge_verb, verb);
  verb->add_option("DIR", options.folders, "Folders of the studies")->required();
  verb->add_option("--into", options.into, "Folder that takes them")->required();
}

}  // namespace repose::program
