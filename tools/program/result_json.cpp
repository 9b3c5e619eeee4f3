#include "tools/program/result_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/base/vec3.hpp"

namespace repose::program {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::array<const char*, 4> kFlankNames = {"+x", "−x", "+y", "−y"};

/// Numbers that are not finite become null when the object is printed.
Json angles_of(const HeapMeasurement& heap) {
  Json angles = Json::array();
  for (const Flank& flank : heap.flanks) angles.push_back(degrees(flank.angle));
  return angles;
}

Json energy_of(const EnergyLedger& energy) {
  return {{"added_J", energy.added},
          {"wall_work_J", energy.wall_work},
          {"kinetic_J", energy.kinetic},
          {"potential_J", energy.potential},
          {"elastic_J", energy.elastic()},
          {"normal_damping_J", energy.normal_damping},
          {"tangential_damping_J", energy.tangential_damping},
          {"friction_J", energy.friction},
          {"rolling_resistance_J", energy.rolling_resistance},
          {"removed_J", energy.removed},
          {"relative_imbalance", energy.relative_imbalance()}};
}

std::string angle_in_words(const HeapMeasurement& heap) {
  std::string flanks;
  for (std::size_t i = 0; i < heap.flanks.size(); ++i)
    flanks += fmt::format("{}{} {:.1f}°", i == 0 ? "" : ", ", kFlankNames[i], degrees(heap.flanks[i].angle));
  return fmt::format("angle of repose {:.2f}° ± {:.2f}°  ({})\n", degrees(heap.angle),
                     degrees(heap.standard_error), flanks);
}

}  // namespace

Json to_json(const RunResult& result, const std::string& title) {
  const HeapMeasurement& heap = result.measurement;
  const bool completed = result.outcome == Outcome::completed;
  Json json;
  json["title"] = title;
  json["outcome"] = name_of(result.outcome);
  json["reason"] = result.reason;
  json["warnings"] = Json::array();
  for (const Warning& warning : result.warnings)
    json["warnings"].push_back({{"name", warning.name}, {"text", warning.text}});
  json["angle_of_repose_deg"] = completed ? Json(degrees(heap.angle)) : Json();
  json["angles_deg"] = completed ? angles_of(heap) : Json(std::array<Json, 4>{});
  json["angle_standard_error_deg"] = completed ? Json(degrees(heap.standard_error)) : Json();
  json["responses"] = {{"mass_on_base_kg", result.responses.mass_on_base},
                       {"mass_lost_kg", result.responses.mass_lost},
                       {"reaches_edge", completed ? Json(result.responses.reaches_edge) : Json()},
                       {"peak_height_mm", result.responses.peak_height * 1e3},
                       {"bulk_density_kg_m3", result.responses.bulk_density},
                       {"rest_time_s", result.responses.rest_time}};
  json["motion"] = {{"largest_energy_imbalance", result.motion.energy_imbalance},
                    {"column_overlap_ratio", result.motion.column_overlap_ratio},
                    {"largest_overlap_ratio", result.motion.largest_overlap_ratio},
                    {"stability_number", result.motion.stability_number}};
  json["energy"] = energy_of(result.energy);
  json["cost"] = {
      {"cpu_s", result.cost.cpu}, {"steps", result.cost.steps}, {"time_step_s", result.cost.time_step}};
  json["bodies"] = result.bodies;
  json["spheres"] = result.spheres;
  json["seed"] = result.seed;
  json["run_key"] = result.run_key;
  json["engine"] = engine_version();
  return json;
}

std::string in_words(const RunResult& result) {
  std::string text;
  if (result.outcome == Outcome::completed) text += angle_in_words(result.measurement);
  if (result.outcome != Outcome::completed)
    text += fmt::format("{}: {}\n", name_of(result.outcome), result.reason);
  for (const Warning& warning : result.warnings)
    text += fmt::format("warning {}: {}\n", warning.name, warning.text);
  const Responses& responses = result.responses;
  if (std::isfinite(responses.mass_on_base))
    text += fmt::format(
        "on the base {:.4g} kg, {:.1f} mm high{}; column {:.0f} kg/m³; at rest {:.2f} s after the opening\n",
        responses.mass_on_base, responses.peak_height * 1e3,
        result.outcome != Outcome::completed ? ""
        : responses.reaches_edge             ? ", out to its edge"
                                             : ", short of its edge",
        responses.bulk_density, responses.rest_time);
  text += fmt::format("{} bodies of {} spheres; {} steps of {:.3g} µs in {:.1f} CPU seconds; seed {}\n",
                      result.bodies, result.spheres, result.cost.steps, result.cost.time_step * 1e6,
                      result.cost.cpu, result.seed);
  return text;
}

}  // namespace repose::program
