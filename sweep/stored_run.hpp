#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "engine/run/run.hpp"

namespace repose::sweep {

/// Outcome of a run that ended in an exception: a fault of the machine (memory, for one), not of the scene.
/// The next sweep tries it again; every other outcome is kept, because the same run would end the same way.
inline constexpr const char* kFailed = "failed";

/// Values of a design's factors by name.
using FactorValues = std::map<std::string, double>;

/// One finished run as study.sqlite holds it, in the units of the columns' names.
struct StoredRun {
  std::string run_key;
  std::optional<int> point;  ///< index in the design of the study's case; none where it has no such point
  int replicate = 0;
  std::int64_t seed = 0;
  double e_pp = 0.0;  ///< of the scene, whether varied or not
  double mu_s = 0.0;
  double mu_r = 0.0;
  FactorValues factors;             ///< as the design named them when the run was made
  std::string variant;              ///< rung of a chart that the run was made for; may be empty
  std::string outcome;              ///< name_of(Outcome) or kFailed
  std::string reason;               ///< may be empty
  std::optional<double> angle_deg;  ///< the angles only for `completed`: no other angle may enter a fit
  std::optional<double> angle_standard_error_deg;
  std::array<std::optional<double>, 4> angles_deg;
  std::string warnings;         ///< their names, joined by blanks; may be empty
  std::string warning_details;  ///< "name: text", joined by " | "
  std::optional<double> mass_on_base_kg;
  std::optional<double> mass_lost_kg;
  std::optional<double> peak_height_mm;
  std::optional<double> bulk_density_kg_m3;
  std::optional<double> rest_time_s;
  std::optional<int> reaches_edge;         ///< of `completed`: 1 where the base's edge cuts the heap, else 0
  std::optional<double> energy_imbalance;  ///< of the ledger at the end (EnergyLedger)
  std::optional<double> column_overlap_ratio;
  std::optional<double> stability_number;
  std::optional<double> cpu_s;
  std::optional<std::int64_t> steps;
  std::optional<double> time_step_s;
  std::optional<int> bodies;
  std::optional<std::int64_t> spheres;
  std::string version;
  std::string finished_at;  ///< UTC, "2026-01-31T12:00:00Z"
  /// Another run of the same point and seed stands for it (succeeds()). Not a column.
  bool superseded = false;

  [[nodiscard]] bool completed() const { return outcome == name_of(Outcome::completed); }
  [[nodiscard]] bool failed() const { return outcome == kFailed; }
};

/// Which of two runs of one point and seed, by two versions of the engine or two instruction sets, stands:
/// one that ended for a reason of its own before one that `failed`, then the later. The same on every
/// machine.
bool succeeds(const StoredRun& run, const StoredRun& other);

/// The one list of columns: visit(name, value) in the order of the table and of an exported CSV.
template <class Run, class Visit>
void visit_columns(Run& run, Visit&& visit) {
  visit("run_key", run.run_key);
  visit("point", run.point);
  visit("replicate", run.replicate);
  visit("seed", run.seed);
  visit("e_pp", run.e_pp);
  visit("mu_s", run.mu_s);
  visit("mu_r", run.mu_r);
  visit("factors", run.factors);
  visit("variant", run.variant);
  visit("outcome", run.outcome);
  visit("reason", run.reason);
  visit("angle_deg", run.angle_deg);
  visit("angle_standard_error_deg", run.angle_standard_error_deg);
  visit("angle_1_deg", run.angles_deg[0]);
  visit("angle_2_deg", run.angles_deg[1]);
  visit("angle_3_deg", run.angles_deg[2]);
  visit("angle_4_deg", run.angles_deg[3]);
  visit("warnings", run.warnings);
  visit("warning_details", run.warning_details);
  visit("mass_on_base_kg", run.mass_on_base_kg);
  visit("mass_lost_kg", run.mass_lost_kg);
  visit("peak_height_mm", run.peak_height_mm);
  visit("bulk_density_kg_m3", run.bulk_density_kg_m3);
  visit("rest_time_s", run.rest_time_s);
  visit("reaches_edge", run.reaches_edge);
  visit("energy_imbalance", run.energy_imbalance);
  visit("column_overlap_ratio", run.column_overlap_ratio);
  visit("stability_number", run.stability_number);
  visit("cpu_s", run.cpu_s);
  visit("steps", run.steps);
  visit("time_step_s", run.time_step_s);
  visit("bodies", run.bodies);
  visit("spheres", run.spheres);
  visit("version", run.version);
  visit("finished_at", run.finished_at);
}

/// How many runs carry a warning, and what it says in the first of them.
struct WarningCount {
  int runs = 0;
  std::string example;  ///< its text
};

/// The warnings of some runs by name.
void count_warnings(const StoredRun& run, std::map<std::string, WarningCount>& counts);

/// Fills outcome, reason, angles, warnings, responses, cost, version and time of finishing from a result.
/// What is not finite is left empty.
void take_result(StoredRun& run, const RunResult& result);

/// Fills outcome `failed`, the reason, version and time of finishing.
void take_failure(StoredRun& run, const std::string& reason);

/// Whether two records of one key hold the same result, bit for bit: everything but what depends on the
/// machine (CPU time, date) or on the design (point, replicate, names of the factors).
bool same_result(const StoredRun& a, const StoredRun& b);

}  // namespace repose::sweep
