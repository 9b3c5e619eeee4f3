#include "sweep/sweep.hpp"

#include <unordered_map>

#include "engine/base/input_error.hpp"
#include "engine/run/run.hpp"
#include "sweep/same_case.hpp"
#include "sweep/stored_runs.hpp"
#include "sweep/study.hpp"

namespace repose::sweep {

namespace {

namespace fs = std::filesystem;

std::unordered_map<std::string, Store::Label> labels_of(const Plan& plan) {
  std::unordered_map<std::string, Store::Label> labels;
  for (const PlannedRun& run : plan.runs) {
    const Store::Label label{static_cast<int>(run.point) + 1, run.replicate, plan.variant_of(run.point)};
    labels.emplace(run.key, label);
    for (const std::string& key : run.other_keys) labels.emplace(key, label);
  }
  return labels;
}

/// Numbers and names the stored runs by the plan where they are not yet.
void label_by(const Plan& plan, const StoredRuns& stored, Store& store) {
  const auto labels = labels_of(plan);
  for (const StoredRun& run : stored.all()) {
    const auto label = labels.find(run.run_key);
    const bool fits = label == labels.end()
                          ? !run.point.has_value()
                          : run.point == label->second.point && run.replicate == label->second.replicate &&
                                run.variant == label->second.variant;
    if (!fits) return store.relabel(labels);
  }
}

CostModel costs_of(const Plan& plan, const StoredRuns& stored) {
  std::vector<double> work;
  for (const PlannedPoint& point : plan.points) work.push_back(estimated_work(point.scene));
  CostModel costs(std::move(work));
  for (const PlannedRun& run : plan.runs) {
    const StoredRun* found = stored.find(run);
    if (found != nullptr && found->cpu_s) costs.learn(run.point, *found->cpu_s);
  }
  return costs;
}

}  // namespace

SweepSummary run_sweep(const CaseDocument& document, const fs::path& folder, const SweepOptions& options) {
  const Plan plan = make_plan(document);
  Study study = open_or_create_study(folder, document);
  const StoredRuns stored(study.store.runs());
  label_by(plan, stored, study.store);
  CostModel costs = costs_of(plan, stored);

  const std::vector<std::size_t> part = runs_of_shard(plan, options.shard);
  std::vector<std::size_t> todo;
  SweepProgress begin;
  begin.planned = static_cast<int>(part.size());
  for (const std::size_t index : part) {
    const PlannedRun& planned = plan.runs[index];
    if (!stored.is_done(planned))
      todo.push_back(index);
    else if (!stored.find(planned)->completed())
      ++begin.failed;
  }
  begin.left = static_cast<int>(todo.size());
  begin.done = begin.planned - begin.left;

  SweepSummary summary = run_all(plan, todo, study.store, costs, begin, options);
  summary.planned = begin.planned;
  summary.present = begin.done;
  summary.left = begin.left - summary.finished;
  const StoredRuns now(study.store.runs());
  for (const std::size_t index : part) {
    const StoredRun* run = now.find(plan.runs[index]);
    if (run == nullptr) continue;
    ++summary.outcomes[run->outcome];
    count_warnings(*run, summary.warnings);
  }
  return summary;
}

StudyStatus status_of(const fs::path& folder) {
  const Study study = open_study(folder);
  const Plan plan = make_plan(study.document);
  const StoredRuns stored(study.store.runs());
  const CostModel costs = costs_of(plan, stored);
  StudyStatus status;
  status.planned = static_cast<int>(plan.runs.size());
  double seconds_left = 0.0;
  bool known = true;
  for (const PlannedRun& run : plan.runs) {
    if (const StoredRun* found = stored.find(run)) {
      ++status.outcomes[found->outcome];
      count_warnings(*found, status.warnings);
      if (!found->completed()) status.not_completed.push_back(*found);
      if (found->version != engine_version()) ++status.of_other_instructions;
    }
    if (stored.is_done(run)) {
      ++status.done;
    } else {
      const auto expected = costs.seconds(run.point);
      known = known && expected.has_value();
      seconds_left += expected.value_or(0.0);
    }
  }
  status.left = status.planned - status.done;
  const auto labels = labels_of(plan);
  for (const StoredRun& run : stored.all())
    if (!labels.contains(run.run_key)) ++status.outside;
  if (known) status.cpu_left_s = seconds_left;
  return status;
}

int merge_studies(const std::vector<fs::path>& folders, const fs::path& into) {
  Faults faults;
  std::vector<Study> studies;
  for (const fs::path& folder : folders) {
    try {
      studies.push_back(open_study(folder));
    } catch (const InputError& error) {
      faults.add(error);
    }
  }
  if (folders.empty()) faults.add(into.string(), "", "", "no study was named to merge into it");
  faults.throw_if_any();

  const bool is_new = !fs::exists(into / kStudyFile);
  const CaseDocument reference = is_new ? studies.front().document : open_study(into).document;
  std::vector<const Store*> stores;
  for (const Study& study : studies) {
    for (const Fault& fault : differences(reference, study.document))
      faults.add(study.folder.string(), fault.pointer, fault.value, fault.rule);
    stores.push_back(&study.store);
  }
  faults.throw_if_any();

  std::vector<std::string> names;
  for (const fs::path& folder : folders) names.push_back(folder.string());
  if (!is_new) names.push_back(into.string());
  const bool had_files = fs::exists(into / kCaseFiles);
  std::vector<std::string> conflicts;
  {
    Study target = is_new ? open_or_create_study(into, reference) : open_study(into);
    conflicts = target.store.take_from(stores);
    if (conflicts.empty()) {
      label_by(make_plan(target.document), StoredRuns(target.store.runs()), target.store);
      return static_cast<int>(target.store.runs().size());
    }
  }
  if (is_new) {  // nothing stays of a study that could not be made
    for (const char* made : {kStudyFile, kCaseFile}) fs::remove(into / made);
    if (!had_files) fs::remove_all(into / kCaseFiles);
    if (fs::is_empty(into)) fs::remove(into);
  }
  for (const std::string& key : conflicts)
    faults.add(fmt::format("{}", fmt::join(names, ", ")), "", key,
               "two of these studies hold different results of this run");
  throw InputError(faults.list());
}

}  // namespace repose::sweep
