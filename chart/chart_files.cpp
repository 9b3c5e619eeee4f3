#include "chart/chart_files.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace repose::chart {

namespace {

using Json = nlohmann::ordered_json;

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return result + "\"";
}

std::string cells(const Estimate& estimate) {
  return fmt::format(",{:.6g},{:.6g}", estimate.value, estimate.standard_error);
}

std::string in_words(const std::map<std::string, int>& outcomes) {
  std::string text;
  for (const auto& [outcome, runs] : outcomes)
    text += fmt::format("{}{} {}", text.empty() ? "" : " ", runs, outcome);
  return text;
}

Json set_of(const sweep::Variant& variant) {
  Json set = Json::object();
  for (const sweep::Override& override : variant.set) set[override.pointer] = override.value;
  return set;
}

Json to_json(const Estimate& estimate) {
  return {{"value", estimate.value}, {"standard_error", estimate.standard_error}};
}

Json to_json(const std::vector<Estimate>& estimates) {
  Json list = Json::array();
  for (const Estimate& estimate : estimates) list.push_back(to_json(estimate));
  return list;
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string text =
      "rung,outcomes,completed,cpu_s,speed_up,angle_difference_deg,angle_difference_se_deg,"
      "worst_difference_deg,worst_difference_se_deg,worst_at,dependence_p,mean_bound_95_deg,error_deg,"
      "error_low_95_deg,error_bound_95_deg,density_difference_percent,density_difference_se_percent,"
      "mass_difference_percent,mass_difference_se_percent,worst_mass_difference_percent,"
      "worst_mass_difference_se_percent,worst_mass_at,mass_dependence_p,off_working_point_deg,off_working_"
      "point_se_deg,"
      "on_front,set\n";
  for (std::size_t k = 0; k < chart.rungs.size(); ++k) {
    const Comparison& rung = chart.rungs[k];
    text +=
        fmt::format("{},{},{},{:.6g},{}", quoted(rung.name), in_words(rung.outcomes), rung.completed ? 1 : 0,
                    rung.cpu, rung.completed ? fmt::format("{:.6g}", rung.speed_up) : "");
    if (rung.completed) {
      const Judgement& angle = rung.angle;
      text += cells(angle.mean) + cells(angle.worst) +
              fmt::format(",{},{:.4g}", quoted(chart.frictions[angle.worst_at]), angle.dependence_p) +
              fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g}", angle.mean_bound_95, angle.error, angle.low_95,
                          angle.bound_95) +
              cells(rung.density.mean) + cells(rung.mass.mean) + cells(rung.mass.worst) +
              fmt::format(",{},{:.4g}", quoted(chart.frictions[rung.mass.worst_at]), rung.mass.dependence_p) +
              (rung.off_working_point ? cells(*rung.off_working_point) : ",,");
    } else {
      text += std::string(20, ',');
    }
    text += fmt::format(",{},{}\n", rung.on_front ? 1 : 0, quoted(set_of(chart.variants[k]).dump()));
  }
  return text;
}

Json to_json(const Comparison& rung, const sweep::Variant& variant) {
  Json json = {{"name", rung.name},           {"set", set_of(variant)}, {"outcomes", rung.outcomes},
               {"completed", rung.completed}, {"reason", rung.reason},  {"cpu_s", rung.cpu}};
  json["speed_up"] = rung.completed ? Json(rung.speed_up) : Json();
  const Judgement& angle = rung.angle;
  const auto known = [&rung](Json value) { return rung.completed ? value : Json(); };
  json["angle_difference_deg"] = known(to_json(angle.mean));
  json["by_friction"] = known(to_json(angle.by_set));
  json["worst_difference_deg"] = known(to_json(angle.worst));
  json["worst_at"] = known(angle.worst_at);
  json["dependence_p"] = known(angle.dependence_p);
  json["mean_bound_95_deg"] = known(angle.mean_bound_95);
  json["error_deg"] = known(angle.error);
  json["error_low_95_deg"] = known(angle.low_95);
  json["error_bound_95_deg"] = known(angle.bound_95);
  json["density_difference_percent"] = known(to_json(rung.density.mean));
  json["mass_difference_percent"] = known(to_json(rung.mass.mean));
  json["mass_by_friction_percent"] = known(to_json(rung.mass.by_set));
  json["mass_dependence_p"] = known(rung.mass.dependence_p);
  json["off_working_point_deg"] = rung.off_working_point ? to_json(*rung.off_working_point) : Json();
  json["one_column"] = rung.one_column;
  json["on_front"] = rung.on_front;
  return json;
}

Json to_json(const Chart& chart) {
  Json json = {{"title", chart.title},
               {"frictions", chart.frictions},
               {"replicates", chart.replicates},
               {"rung_replicates", chart.rung_replicates},
               {"missing_runs", chart.missing_runs},
               {"engines", chart.engines},
               {"unfinished", chart.unfinished}};
  json["reference"] = {{"set", set_of(chart.reference_variant)},
                       {"outcomes", chart.reference_outcomes},
                       {"cpu_s", chart.reference_cpu},
                       {"angle_deg", to_json(chart.reference_angle)},
                       {"scatter_of_one_run_deg", chart.scatter}};
  json["rungs"] = Json::array();
  for (std::size_t k = 0; k < chart.rungs.size(); ++k)
    json["rungs"].push_back(to_json(chart.rungs[k], chart.variants[k]));
  return json;
}

}  // namespace repose::chart
