#include "chart/chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/slump/shared_column.hpp"
#include "sweep/stored_runs.hpp"
#include "sweep/study.hpp"

namespace repose::chart {

namespace {

Sample sample_of(const sweep::StoredRun& run, std::optional<std::uint64_t> column) {
  return {run.outcome,
          run.reason,
          run.angle_deg.value_or(0.0),
          run.bulk_density_kg_m3.value_or(0.0),
          run.mass_on_base_kg.value_or(0.0),
          run.cpu_s.value_or(0.0),
          run.version,
          column};
}

/// The runs of a rung (0: the reference) that are there, up to the first that is missing of each set. A run
/// is found by its key, because two rungs can be the same test.
Samples samples_of(const sweep::Plan& plan, std::size_t rung, const sweep::StoredRuns& runs) {
  Samples samples;
  for (const sweep::PlannedPoint& point : plan.points) {
    if (point.rung != rung) continue;
    std::vector<Sample>& set = samples.emplace_back();
    for (int replicate = 1; replicate <= plan.design.ladder.replicates_of(rung); ++replicate) {
      const std::uint64_t seed = seed_of(plan.design, point.values, replicate);
      const sweep::StoredRun* found = runs.find(point.scene, seed);
      if (found == nullptr) break;
      std::optional<std::uint64_t> column;
      if (const auto& columns = point.scene.test.shared_columns) column = number_of_column(*columns, seed);
      set.push_back(sample_of(*found, column));
    }
  }
  return samples;
}

/// How many runs every set has.
std::size_t shortest(const Samples& samples) {
  return std::ranges::min(samples, {}, &std::vector<Sample>::size).size();
}

void cut(Samples& samples, std::size_t runs) {
  for (std::vector<Sample>& set : samples) set.resize(runs);
}

std::string words_of(const std::vector<std::string>& names, const std::vector<double>& values) {
  std::string text;
  for (std::size_t f = 0; f < names.size(); ++f)
    text += fmt::format("{}{} = {:g}", f == 0 ? "" : ", ", names[f], values[f]);
  return text;
}

void note_engines(Chart& chart, const Samples& samples) {
  for (const std::vector<Sample>& set : samples)
    for (const Sample& sample : set) chart.engines.insert(sample.engine);
}

void add_reference(Chart& chart, const Samples& reference) {
  note_engines(chart, reference);
  chart.reference_outcomes = outcomes_of(reference);
  chart.reference_cpu = mean_cpu(reference);
  if (const Sample* failure = first_failure(reference)) {
    chart.reference_failure = fmt::format("{}: {}", failure->outcome, failure->reason);
    return;
  }
  chart.reference_angle = estimates_of(angles_of(reference));
  chart.scatter = scatter_of_angle(reference);
}

void add_rungs(Chart& chart, const sweep::Plan& plan, const sweep::StoredRuns& runs,
               const Samples& reference) {
  const std::vector<sweep::Variant>& ladder = plan.design.ladder.rungs;
  Samples working_point;  // if it completed
  for (std::size_t rung = 0; rung < ladder.size(); ++rung) {
    Samples samples = samples_of(plan, rung + 1, runs);
    const auto needed = static_cast<std::size_t>(chart.rung_replicates);
    if (shortest(samples) < needed) {
      chart.unfinished.push_back(ladder[rung].name);
      continue;
    }
    cut(samples, needed);
    chart.variants.push_back(ladder[rung]);
    note_engines(chart, samples);
    Comparison& comparison = chart.rungs.emplace_back(compare(ladder[rung].name, samples, reference));
    chart.differences.push_back(comparison.completed ? angle_differences(samples, reference) : Differences{});
    if (!comparison.completed) continue;
    if (rung == 0 && plan.design.ladder.has_working_point) working_point = samples;
    if (!working_point.empty())
      comparison.off_working_point = judge(angle_differences(samples, working_point)).mean;
  }
  mark_front(chart.rungs, chart.reference_cpu);
}

}  // namespace

Chart read_chart(const std::filesystem::path& folder) {
  const sweep::Study study = sweep::open_study(folder);
  const sweep::Plan plan = sweep::make_plan(study.document);
  const sweep::StoredRuns runs(study.store.runs());

  const sweep::Ladder& ladder = plan.design.ladder;
  Chart chart;
  chart.document = study.document;
  chart.title = plan.points.front().scene.title;
  for (const std::vector<double>& values : ladder.frictions)
    chart.frictions.push_back(words_of(ladder.friction_names, values));
  chart.missing_runs = static_cast<int>(
      std::ranges::count_if(plan.runs, [&](const auto& run) { return runs.find(run) == nullptr; }));
  chart.reference_variant = ladder.reference;
  if (ladder.has_working_point) chart.working_point = ladder.rungs.front().set;
  Samples reference = samples_of(plan, 0, runs);
  const std::size_t replicates = shortest(reference);
  chart.replicates = static_cast<int>(replicates);
  chart.rung_replicates = chart.replicates * (ladder.rung_replicates / ladder.replicates);
  if (replicates < 2) return chart;
  cut(reference, replicates);
  add_reference(chart, reference);
  if (chart.has_reference()) add_rungs(chart, plan, runs, reference);
  return chart;
}

sweep::Variant anywhere(sweep::Variant variant, const Chart& chart) {
  for (sweep::Override& override : variant.set)
    override.value = with_absolute_paths(chart.document, override);
  return variant;
}

namespace {

/// It is the first rung, if it is there.
bool has_working_point(const Chart& chart) {
  return !chart.working_point.empty() && !chart.rungs.empty() && chart.rungs.front().completed &&
         chart.variants.front().name == sweep::kWorkingPoint;
}

Candidate candidate_of(const Chart& chart, std::size_t rung) {
  const Comparison& comparison = chart.rungs[rung];
  Candidate candidate{comparison.name, {}, chart.differences[rung], comparison.cpu / chart.reference_cpu};
  // Where the working point failed, so that nothing is known of it, its settings keep its rungs apart.
  const sweep::Variant& variant = chart.variants[rung];
  const bool on_ground = has_working_point(chart);
  for (const sweep::Override& override : on_ground ? variant.own() : std::span(variant.set))
    candidate.pointers.push_back(override.pointer);
  return candidate;
}

}  // namespace

std::optional<Candidate> working_point_of(const Chart& chart) {
  if (!has_working_point(chart)) return std::nullopt;
  return candidate_of(chart, 0);
}

std::vector<Candidate> candidates_of(const Chart& chart) {
  const Comparison* ground = has_working_point(chart) ? &chart.rungs.front() : nullptr;
  std::vector<Candidate> candidates;
  for (std::size_t rung = ground != nullptr ? 1 : 0; rung < chart.rungs.size(); ++rung) {
    const Comparison& comparison = chart.rungs[rung];
    if (!comparison.completed || !(comparison.cpu < chart.reference_cpu)) continue;
    if (ground == nullptr || comparison.cpu < ground->cpu ||
        comparison.angle.bound_95 < ground->angle.bound_95)
      candidates.push_back(candidate_of(chart, rung));
  }
  return candidates;
}

sweep::Variant variant_of(const Combination& combination, const std::vector<Candidate>& candidates,
                          const Chart& chart) {
  sweep::Variant variant{name_of(combination, candidates), {}};
  for (const std::size_t index : combination.rungs) {
    const auto rung = std::ranges::find(chart.variants, candidates[index].name, &sweep::Variant::name);
    variant.set.insert(variant.set.end(), rung->own().begin(), rung->own().end());
  }
  return anywhere(sweep::on_working_point(chart.working_point, std::move(variant)), chart);
}

}  // namespace repose::chart
