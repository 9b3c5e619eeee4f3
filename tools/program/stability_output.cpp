#include "tools/program/stability_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/scene/names.hpp"

namespace repose::program {

namespace {

using Json = nlohmann::ordered_json;

std::string rolling_of(const MapRow& row) { return row.any_rolling ? "any" : rolling_name(row.method); }

/// Nothing for 0, which stands for "none".
Json number(double value) { return value > 0.0 && std::isfinite(value) ? Json(value) : Json(nullptr); }
std::string cell(double value) {
  return value > 0.0 && std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return out + '"';
}

std::string failure_of(const MapRow& row) {
  return row.cliff.failure == Failure::none ? std::string() : name_of(row.cliff.failure);
}

std::string key_cells(const MapRow& row) {
  return fmt::format("{},{},{},{:.9g}", name_of(row.test), choice_name(row.method.integrator),
                     rolling_of(row), row.stiffness_scale);
}

Json row_json(const MapRow& row) {
  const Probe* last = row.cliff.last_stable();
  const double step = row.cliff.stable;
  return {{"test", name_of(row.test)},
          {"integrator", choice_name(row.method.integrator)},
          {"rolling_model", rolling_of(row)},
          {"stiffness_scale", row.stiffness_scale},
          {"largest_stable_step_s", number(step)},
          {"of_rayleigh_smallest", number(step / row.smallest_rayleigh)},
          {"of_rayleigh_equivalent", number(step / row.equivalent_rayleigh)},
          {"of_sqrt_m_over_K", row.stiffness_time > 0.0 ? number(step / row.stiffness_time) : Json(nullptr)},
          {"over_auto", number(step / row.automatic)},
          {"smallest_unstable_step_s", number(row.cliff.unstable)},
          {"fails_by", row.cliff.failure == Failure::none ? Json(nullptr) : Json(failure_of(row))},
          {"energy_error", last ? Json(last->energy_error) : Json(nullptr)},
          {"overlap_ratio", last ? Json(last->overlap) : Json(nullptr)},
          {"reason", row.reason}};
}

Json recommendation_json(const Recommendation& found) {
  const double cliff = found.largest_stable, article = 0.3 * found.smallest_rayleigh;
  return {{"integrator", choice_name(found.method.integrator)},
          {"rolling_model", rolling_name(found.method)},
          {"limited_by", name_of(found.limit)},
          {"largest_stable_step_s", cliff},
          {"safety_margin", kSafetyMargin},
          {"time_step_s", found.step},
          {"time_step_fraction", found.step / found.smallest_rayleigh},
          {"auto_time_step_s", found.automatic},
          {"auto_margin", cliff / found.automatic},
          {"case_time_step_s", found.own},
          {"case_margin", cliff / found.own},
          {"thirty_percent_of_rayleigh_s", article},
          {"thirty_percent_margin", cliff / article}};
}

std::vector<double> stiffnesses_of(const StabilityMap& map) {
  std::vector<double> scales;
  for (const MapRow& row : map.rows)
    if (std::ranges::find(scales, row.stiffness_scale) == scales.end()) scales.push_back(row.stiffness_scale);
  return scales;
}

const MapRow* find_row(const StabilityMap& map, StabilityTest test, const Method& method, double scale) {
  for (const MapRow& row : map.rows)
    if (row.test == test && row.stiffness_scale == scale &&
        (row.any_rolling ? row.method.integrator == method.integrator : row.method == method))
      return &row;
  return nullptr;
}

/// Methods of the map in its order.
std::vector<Method> methods_of(const StabilityMap& map) {
  std::vector<Method> methods;
  for (const MapRow& row : map.rows)
    if (!row.any_rolling && std::ranges::find(methods, row.method) == methods.end())
      methods.push_back(row.method);
  return methods;
}

using Measure = double (*)(const MapRow&);

std::string table(const StabilityMap& map, double scale, Measure measure) {
  std::string text = fmt::format("  {:<17} {:<17}", "integrator", "rolling model");
  for (const StabilityTest test : kStabilityTests) text += fmt::format("{:>16}", name_of(test));
  text += '\n';
  for (const Method& method : methods_of(map)) {
    text += fmt::format("  {:<17} {:<17}", choice_name(method.integrator), rolling_name(method));
    for (const StabilityTest test : kStabilityTests) {
      const MapRow* row = find_row(map, test, method, scale);
      const bool known = row && row->cliff.stable > 0.0;
      const bool at_least = known && !(row->cliff.unstable > 0.0);
      text += fmt::format(
          "{:>16}", known ? fmt::format("{}{:.2g}", at_least ? ">" : "", row->cliff.stable / measure(*row))
                          : std::string("-"));
    }
    text += '\n';
  }
  return text;
}

/// Why there are gaps in the table of a stiffness, each reason once.
std::string gaps(const StabilityMap& map, double scale) {
  std::map<std::string, int> reasons;
  for (const MapRow& row : map.rows)
    if (row.stiffness_scale == scale && !row.measured())
      ++reasons[fmt::format("{}: {}", name_of(row.test), row.reason)];
  std::string text;
  for (const auto& [reason, count] : reasons) text += fmt::format("  - {} × {}\n", count, reason);
  return text;
}

std::string margin_text(double margin) {
  return margin >= 1.0 ? fmt::format("a margin of {:.1f}", margin)
                       : fmt::format("beyond the cliff, {:.1f} times", 1.0 / margin);
}

std::string advice(const Recommendation& found) {
  const double T_R = found.smallest_rayleigh, cliff = found.largest_stable, article = 0.3 * T_R;
  std::string text = fmt::format("For {}, {}: the first to fail is {}, beyond {:.3g} s = {:.2g} T_R.\n",
                                 choice_name(found.method.integrator), rolling_name(found.method),
                                 name_of(found.limit), cliff, cliff / T_R);
  text += fmt::format("  with a margin of {:.0f}  {:.3g} s = {:.2g} T_R\n", kSafetyMargin, found.step,
                      found.step / T_R);
  const auto line = [&](const char* name, double step) {
    return fmt::format("  {:<17} {:.3g} s = {:.2g} T_R, {}\n", name, step, step / T_R,
                       margin_text(cliff / step));
  };
  return text + line("\"auto\"", found.automatic) + line("the case", found.own) +
         line("30 % of T_R", article);
}

}  // namespace

std::string stability_csv(const StabilityMap& map) {
  std::string text =
      "test,integrator,rolling_model,stiffness_scale,largest_stable_step_s,of_rayleigh_smallest,"
      "of_rayleigh_equivalent,of_sqrt_m_over_K,over_auto,smallest_unstable_step_s,fails_by,energy_error,"
      "overlap_ratio,"
      "reason\n";
  for (const MapRow& row : map.rows) {
    const Probe* last = row.cliff.last_stable();
    const double step = row.cliff.stable;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{}\n", key_cells(row), cell(step), cell(step / row.smallest_rayleigh),
        cell(step / row.equivalent_rayleigh), row.stiffness_time > 0.0 ? cell(step / row.stiffness_time) : "",
        cell(step / row.automatic), cell(row.cliff.unstable), failure_of(row),
        last ? fmt::format("{:.6g}", last->energy_error) : "",
        last ? fmt::format("{:.6g}", last->overlap) : "", row.reason.empty() ? "" : quoted(row.reason));
  }
  return text;
}

std::string energy_error_csv(const StabilityMap& map) {
  std::string text =
      "test,integrator,rolling_model,stiffness_scale,step_s,of_rayleigh_smallest,of_rayleigh_equivalent,"
      "of_sqrt_m_over_K,energy_error,overlap_ratio,failure\n";
  for (const MapRow& row : map.rows)
    for (const Probe& probe : row.cliff.probes)
      text += fmt::format("{},{:.9g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", key_cells(row), probe.step,
                          probe.step / row.smallest_rayleigh, probe.step / row.equivalent_rayleigh,
                          probe.step / row.stiffness_time, probe.energy_error, probe.overlap,
                          name_of(probe.failure));
  return text;
}

Json to_json(const StabilityMap& map, const Scene& scene) {
  Json json = {{"title", scene.title}, {"interrupted", map.interrupted}};
  json["recommendation"] = map.recommendation ? recommendation_json(*map.recommendation) : Json(nullptr);
  json["reason"] = map.reason;
  json["rows"] = Json::array();
  for (const MapRow& row : map.rows) json["rows"].push_back(row_json(row));
  return json;
}

std::string in_words(const StabilityMap& map, const Scene& scene) {
  std::string text;
  for (const double scale : stiffnesses_of(map)) {
    const MapRow& any = *std::ranges::find(map.rows, scale, &MapRow::stiffness_scale);
    text += fmt::format(
        "Largest stable step over T_R of the smallest sphere, {:.3g} s, at stiffness scale {:.3g}\n"
        "(over that of the sphere of the particle's volume, {:.3g} s: {:.2g} times as much)\n{}{}\n",
        any.smallest_rayleigh, scale, any.equivalent_rayleigh,
        any.smallest_rayleigh / any.equivalent_rayleigh,
        table(map, scale, [](const MapRow& row) { return row.smallest_rayleigh; }), gaps(map, scale));
    if (scale == scene.numerics.stiffness_scale)
      text += fmt::format("The same over √(m/ΣK) of the stiffest body of the experiment\n{}\n",
                          table(map, scale, [](const MapRow& row) { return row.stiffness_time; }));
  }
  if (map.recommendation)
    text += advice(*map.recommendation);
  else if (!map.interrupted)
    text += "No step can be recommended: " + map.reason + "\n";
  return text;
}

}  // namespace repose::program
