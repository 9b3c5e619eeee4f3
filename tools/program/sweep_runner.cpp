#include "tools/program/sweep_runner.hpp"

#include <fmt/format.h>

#include "sweep/plan.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"

namespace repose::program {

namespace {

std::string progress_in_words(const sweep::SweepProgress& progress) {
  std::string text = fmt::format("{} of {} runs done", progress.done, progress.planned);
  if (progress.failed > 0) text += fmt::format(" ({} not completed)", progress.failed);
  text += fmt::format(", {} running, {} left", progress.running, progress.left);
  if (progress.left > 0 && progress.eta_s) text += ", about " + duration_text(*progress.eta_s);
  return text;
}

/// The case and its options, checked to the last fault.
CaseDocument checked_case(const SweepRequest& request, sweep::SweepOptions& options, Faults faults) {
  check_folder(faults, request.folder);
  if (request.threads) {
    check_threads(faults, *request.threads);
    options.threads = *request.threads;
  }
  CaseDocument document;
  try {
    if (!request.shard.empty()) options.shard = sweep::parse_shard(request.shard);
  } catch (const InputError& error) {
    faults.add(error);
  }
  try {
    document = CaseDocument::load(request.case_file);
    if (request.prepare) document = request.prepare(document);
    // The sweep checks the design itself; here only where there are other faults to be named with it.
    if (!faults.empty()) sweep::make_plan(document);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  return document;
}

}  // namespace

sweep::SweepSummary sweep_case(const SweepRequest& request, Faults faults) {
  sweep::SweepOptions options;
  const CaseDocument document = checked_case(request, options, std::move(faults));
  ProgressLine line(request.quiet);
  options.stop = &watch_for_interrupt();
  options.on_finished = request.on_finished;
  options.on_progress = [&](const sweep::SweepProgress& progress) {
    if (line.due()) line.show_now(progress_in_words(progress));
  };
  return sweep::run_sweep(document, request.folder, options);
}

int exit_code_of(const sweep::SweepSummary& summary) {
  if (summary.interrupted) return kInterrupted;
  for (const auto& [outcome, runs] : summary.outcomes)
    if (outcome != name_of(Outcome::completed) && runs > 0) return kNotCompleted;
  return kDone;
}

std::string in_words(const std::map<std::string, int>& outcomes) {
  std::string text;
  for (const auto& [outcome, runs] : outcomes)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", runs, outcome);
  return text;
}

std::string in_words(const std::map<std::string, sweep::WarningCount>& warnings) {
  std::string text;
  for (const auto& [name, count] : warnings)
    text += fmt::format("{} × {}: {}\n", count.runs, name, count.example);
  return text;
}

nlohmann::ordered_json warnings_json(const std::map<std::string, sweep::WarningCount>& warnings) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [name, count] : warnings) json[name] = {{"runs", count.runs}, {"example", count.example}};
  return json;
}

std::string in_words(const sweep::SweepSummary& summary) {
  std::string text = fmt::format("{} of {} runs done", summary.planned - summary.left, summary.planned);
  if (!summary.outcomes.empty()) text += fmt::format(" ({})", in_words(summary.outcomes));
  if (summary.finished > 0)
    text += fmt::format("; {} now, in {}", summary.finished, duration_text(summary.wall_s));
  if (summary.interrupted) text += "; interrupted, the same command goes on from here";
  return text;
}

nlohmann::ordered_json to_json(const sweep::SweepSummary& summary) {
  return {{"planned", summary.planned},
          {"present", summary.present},
          {"finished", summary.finished},
          {"left", summary.left},
          {"outcomes", summary.outcomes},
          {"warnings", warnings_json(summary.warnings)},
          {"interrupted", summary.interrupted},
          {"wall_s", summary.wall_s},
          {"cpu_s", summary.cpu_s}};
}

}  // namespace repose::program
