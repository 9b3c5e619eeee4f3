#include "sweep/stored_run.hpp"

#include <fmt/chrono.h>
#include <chrono>
#include <cmath>
#include <string_view>
#include <tuple>

#include "engine/base/vec3.hpp"

namespace repose::sweep {

namespace {

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string now() {
  const auto time = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

const std::string kBetween = " | ", kColon = ": ";

auto result_of(const StoredRun& run) {
  return std::tie(run.seed, run.e_pp, run.mu_s, run.mu_r, run.outcome, run.angle_deg,
                  run.angle_standard_error_deg, run.angles_deg, run.warnings, run.mass_on_base_kg,
                  run.peak_height_mm, run.bulk_density_kg_m3, run.rest_time_s, run.steps, run.time_step_s,
                  run.bodies, run.spheres);
}

}  // namespace

void take_result(StoredRun& run, const RunResult& result) {
  run.outcome = name_of(result.outcome);
  run.reason = result.reason;
  if (result.outcome == Outcome::completed) {
    const HeapMeasurement& measured = result.measurement;
    run.angle_deg = finite(degrees(measured.angle));
    run.angle_standard_error_deg = finite(degrees(measured.standard_error));
    for (std::size_t i = 0; i < measured.flanks.size(); ++i)
      run.angles_deg[i] = finite(degrees(measured.flanks[i].angle));
  }
  run.warnings.clear();
  run.warning_details.clear();
  for (const Warning& warning : result.warnings) {
    run.warnings += (run.warnings.empty() ? "" : " ") + warning.name;
    run.warning_details +=
        (run.warning_details.empty() ? "" : kBetween) + warning.name + kColon + warning.text;
  }
  run.mass_on_base_kg = finite(result.responses.mass_on_base);
  run.mass_lost_kg = finite(result.responses.mass_lost);
  run.peak_height_mm = finite(1e3 * result.responses.peak_height);
  run.bulk_density_kg_m3 = finite(result.responses.bulk_density);
  run.rest_time_s = finite(result.responses.rest_time);
  if (result.outcome == Outcome::completed) run.reaches_edge = result.responses.reaches_edge ? 1 : 0;
  run.energy_imbalance = finite(result.energy.relative_imbalance());
  run.column_overlap_ratio = finite(result.motion.column_overlap_ratio);
  run.stability_number = finite(result.motion.stability_number);
  run.cpu_s = finite(result.cost.cpu);
  run.steps = result.cost.steps;
  run.time_step_s = finite(result.cost.time_step);
  run.bodies = result.bodies;
  run.spheres = result.spheres;
  run.version = engine_version();
  run.finished_at = now();
}

void count_warnings(const StoredRun& run, std::map<std::string, WarningCount>& counts) {
  std::string_view rest = run.warning_details;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(kBetween));
    rest.remove_prefix(std::min(rest.size(), one.size() + kBetween.size()));
    const std::size_t colon = one.find(kColon);
    if (colon == std::string_view::npos) continue;
    WarningCount& count = counts[std::string(one.substr(0, colon))];
    if (count.runs++ == 0) count.example = one.substr(colon + kColon.size());
  }
}

void take_failure(StoredRun& run, const std::string& reason) {
  run.outcome = kFailed;
  run.reason = reason;
  run.version = engine_version();
  run.finished_at = now();
}

bool succeeds(const StoredRun& run, const StoredRun& other) {
  const auto rank = [](const StoredRun& of) { return std::tie(of.finished_at, of.run_key); };
  return run.failed() != other.failed() ? other.failed() : rank(run) > rank(other);
}

bool same_result(const StoredRun& a, const StoredRun& b) { return result_of(a) == result_of(b); }

}  // namespace repose::sweep
