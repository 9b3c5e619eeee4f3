#include "fit/fit_json.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fit/selection.hpp"

namespace repose::fit {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> kNames = {"C", "a", "b", "c"};

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
json range(const Range& r) { return json::array({number(r.low), number(r.high)}); }

json matrix(const Eigen::Matrix4d& m) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < 4; ++i) {
    rows.push_back({number(m(i, 0)), number(m(i, 1)), number(m(i, 2)), number(m(i, 3))});
  }
  return rows;
}

json point(const Observation& row) {
  json object = {{"e_pp", number(row.e)},
                 {"mu_s", number(row.mu_s)},
                 {"mu_r", number(row.mu_r)},
                 {"angle_deg", number(row.angle)},
                 {"replicate", row.replicate}};
  if (!row.label.empty()) object["label"] = row.label;
  return object;
}

// Σ of (ln C, a, b, c) and Σ of (C, a, b, c) differ by a factor C in the first row and column.
Eigen::Matrix4d scaled(const Eigen::Matrix4d& covariance, double factor) {
  Eigen::Matrix4d result = covariance;
  result.row(0) *= factor;
  result.col(0) *= factor;
  return result;
}

json correction(const Correction& c) {
  json object = {{"cheap_rows", c.cheap_rows}, {"reference_rows", c.reference_rows}};
  const std::array<const Estimate*, 4> parameters = {&c.C, &c.a, &c.b, &c.c};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    object[kNames[i]] = parameters[i]->value;
    object["standard_error"][kNames[i]] =
        parameters[i]->identified ? number(parameters[i]->standard_error) : json();
    object["identified"][kNames[i]] = parameters[i]->identified;
  }
  return object;
}

json factors(const Factors& f) { return {{"e_pp", f.e}, {"mu_s", f.mu_s}, {"mu_r", f.mu_r}}; }

}  // namespace

json to_json(const PowerLaw& law) {
  json object = {{"loss", name_of(law.loss)}, {"parameters", kNames}};
  const auto parameters = law.parameters();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    object[kNames[i]] = parameters[i]->value;
    object["standard_error"][kNames[i]] = number(parameters[i]->standard_error);
    object["interval_95"][kNames[i]] =
        parameters[i]->identified ? range(parameters[i]->interval_95) : json(nullptr);
    object["identified"][kNames[i]] = parameters[i]->identified;
  }
  object["correlation"] = matrix(law.correlation());
  object["covariance"] = matrix(scaled(law.covariance, law.C.value));
  object["worst_error_deg"] = law.worst_error;
  object["worst_point"] = point(law.worst_point);
  object["worst_point"]["predicted_deg"] = number(law.predict(factors_of(law.worst_point)));
  object["rms_error_deg"] = law.rms_error;
  object["r_squared"] = number(law.r_squared);
  object["residual_sd_deg"] = number(law.error.standard_deviation);
  object["misfit_deg"] = law.error.misfit;
  object["degrees_of_freedom"] = law.error.degrees_of_freedom;
  object["pure_error_deg"] = number(law.error.pure_error);
  object["lack_of_fit_p"] = number(law.error.lack_of_fit_p);
  object["points"] = law.points;
  object["distinct_points"] = law.distinct_points;
  object["excluded"] = json::array();
  for (const Excluded& row : law.excluded) {
    object["excluded"].push_back(point(row.observation));
    object["excluded"].back()["reason"] = row.reason;
  }
  object["remarks"] = law.remarks;
  if (law.correction) object["correction"] = correction(*law.correction);
  object["domain"] = {{"e_pp", range(law.domain.e)},
                      {"mu_s", range(law.domain.mu_s)},
                      {"mu_r", range(law.domain.mu_r)},
                      {"angle_deg", range(law.domain.angle)}};
  return object;
}

json to_json(const Inversion& inversion) {
  json object = {{"angle_deg", inversion.question.angle},
                 {"sigma_deg", inversion.question.sigma},
                 {"e_pp", inversion.e},
                 {"e_pp_source", inversion.e_is_given ? "given" : "geometric mean of the domain"},
                 {"restitution_effect_deg", inversion.restitution_effect},
                 {"reachable_deg", range(inversion.reachable)},
                 {"identifiable", inversion.identifiable},
                 {"level_set", json::array()}};
  for (const LevelPoint& at : inversion.level_set) {
    object["level_set"].push_back({{"mu_s", at.mu_s},
                                   {"mu_r", at.mu_r},
                                   {"mu_s_band", range(at.mu_s_band)},
                                   {"mu_r_band", range(at.mu_r_band)}});
  }
  if (inversion.solution) {
    const Solution& solution = *inversion.solution;
    const char* solved = solution.solved_mu_s ? "mu_s" : "mu_r";
    const Factor factor = solution.solved_mu_s ? Factor::mu_s : Factor::mu_r;
    object["solution"] = factors(solution.value);
    object["solution"]["solved_for"] = solved;
    object["solution"]["interval_95"] = {
        {solved, range({value_of(solution.low, factor), value_of(solution.high, factor)})}};
    object["solution"]["interval_reaches_the_edge"] = solution.reaches_the_edge;
  }
  if (!inversion.remark.empty()) object["remark"] = inversion.remark;
  return object;
}

}  // namespace repose::fit
