#include "tools/program/response_source.hpp"

#include <fmt/format.h>

#include <limits>

#include <fstream>
#include <map>
#include <set>

#include "engine/base/json_file.hpp"
#include "fit/fit_json.hpp"
#include "sweep/ladder.hpp"
#include "sweep/study.hpp"
#include "tools/program/response_csv.hpp"

namespace repose::program {

namespace fs = std::filesystem;

namespace {

/// The first character that is not a blank, 0 for an empty file.
char first_character(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char c = 0;
  stream >> c;
  return stream ? c : '\0';
}

bool is_saved_fit(const fs::path& source) {
  if (fs::is_directory(source)) return false;
  // What is no regular file, a pipe, can be read only once.
  return source.extension() == ".json" || (fs::is_regular_file(source) && first_character(source) == '{');
}

/// Factors beside the three of the equation that take more than one value.
std::vector<std::string> other_factors(const std::vector<sweep::StoredRun>& runs) {
  std::map<std::string, std::set<double>> values;
  for (const sweep::StoredRun& run : runs)
    if (run.point)
      for (const auto& [name, value] : run.factors) values[name].insert(value);
  std::vector<std::string> names;
  for (const auto& [name, taken] : values)
    if (taken.size() > 1 && name != "e_pp" && name != "mu_s" && name != "mu_r" &&
        !name.starts_with("/contact/particle_particle/"))
      names.push_back(name);
  return names;
}

/// The rows of a sweep's folder or a CSV; what is wrong with it is added.
StudyResponses responses_of(const fs::path& source, Faults& faults) {
  try {
    if (is_saved_fit(source))
      throw InputError({source.string(), "", "", "is JSON; a fit needs a sweep's folder or a CSV"});
    if (fs::is_directory(source)) return read_responses(sweep::open_study(source));
    return {read_response_csv(source), {}};
  } catch (const InputError& error) {
    faults.add(error);
    return {};
  }
}

}  // namespace

fit::Observation observation_of(const sweep::StoredRun& run) {
  fit::Observation point;
  point.e = run.e_pp;
  point.mu_s = run.mu_s;
  point.mu_r = run.mu_r;
  point.replicate = run.replicate;
  point.angle = run.angle_deg.value_or(std::numeric_limits<double>::quiet_NaN());
  point.standard_error = run.angle_standard_error_deg.value_or(0.0);
  point.label = run.point ? fmt::format("point {}, replicate {}", *run.point, run.replicate)
                          : "run " + run.run_key.substr(0, 8);
  if (!run.completed())
    point.exclusion = run.outcome + (run.reason.empty() ? "" : ": " + run.reason);
  else if (!run.point)
    point.exclusion = "not in the study's design any more";
  else if (!run.angle_deg)
    point.exclusion = "no angle";
  else if (!run.variant.empty() && run.variant != sweep::kReference)
    point.exclusion = "rung of a chart: " + run.variant;
  return point;
}

StudyResponses read_responses(const sweep::Study& study) {
  const std::vector<sweep::StoredRun> runs = sweep::runs_of(study.store);
  StudyResponses responses;
  for (const sweep::StoredRun& run : runs)
    if (!run.superseded) responses.table.push_back(observation_of(run));
  for (const std::string& name : other_factors(runs))
    responses.remarks.push_back("the design varies " + name +
                                " too; the equation takes its effect as scatter of the angle");
  return responses;
}

fit::PowerLaw fit_of(const StudyResponses& responses, fit::Loss loss) {
  fit::PowerLaw law = fit::fit_power_law(responses.table, loss);
  law.remarks.insert(law.remarks.end(), responses.remarks.begin(), responses.remarks.end());
  return law;
}

fit::PowerLaw fitted_law_of(const fs::path& source, fit::Loss loss, const fs::path& cheap) {
  Faults faults;
  StudyResponses responses = responses_of(source, faults);
  std::error_code missing;
  if (!cheap.empty() && fs::equivalent(source, cheap, missing))
    faults.add("--cheap", "", cheap.string(), "must be another source than the reference's");
  if (!cheap.empty()) {
    StudyResponses more = responses_of(cheap, faults);
    for (fit::Observation& row : more.table) {
      row.cheap = true;
      row.label = "cheap: " + row.label;
      responses.table.push_back(std::move(row));
    }
    responses.remarks.insert(responses.remarks.end(), more.remarks.begin(), more.remarks.end());
  }
  faults.throw_if_any();
  return fit_of(responses, loss);
}

fit::PowerLaw law_of(const fs::path& source, fit::Loss loss) {
  if (!is_saved_fit(source)) return fitted_law_of(source, loss);
  try {
    return fit::power_law_from_json(read_json(source), source.string());
  } catch (const fit::BadSavedFit& error) {  // one by one, with those of the question
    Faults faults;
    for (const auto& [pointer, value, rule] : error.faults())
      faults.add(source.string(), pointer, value, rule);
    throw InputError(faults.list());
  }
}

}  // namespace repose::program
