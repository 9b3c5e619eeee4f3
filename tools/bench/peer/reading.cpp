#include "tools/bench/peer/reading.hpp"

#include "engine/base/input_error.hpp"
#include "engine/measure/heap_measurement.hpp"
#include "tools/bench/peer/liggghts_dump.hpp"

namespace repose::peer {

using Json = nlohmann::ordered_json;

Schedule schedule_of(const Json& result) {
  constexpr double kHold = 0.02;
  const std::string outcome = result.value("outcome", "");
  if (outcome != "completed" && outcome != "no_heap")
    throw InputError(
        {"", "/outcome", outcome, "Repose's run did not come to rest: there is nothing to compare"});
  const double end = result.at("/cost/steps"_json_pointer).get<double>() *
                     result.at("/cost/time_step_s"_json_pointer).get<double>();
  return {end - result.at("/responses/rest_time_s"_json_pointer).get<double>() - kHold, end};
}

Json read_run(const Scene& scene, std::uint64_t seed, const std::filesystem::path& folder) {
  const std::vector<Template> kinds = templates_of(scene, seed);
  const HeapSnapshot column = read_liggghts_dump(folder / kColumnDump, kinds, scene.test);
  const HeapSnapshot heap = read_liggghts_dump(folder / kHeapDump, kinds, scene.test);
  const HeapMeasurement measured = measure_heap(heap, scene.measure);
  const double density = scene.particles.material.density;
  Json json;
  json["angle_of_repose_deg"] = measured.has_heap ? Json(degrees(measured.angle)) : Json();
  json["angle_standard_error_deg"] = measured.has_heap ? Json(degrees(measured.standard_error)) : Json();
  json["reason"] = measured.reason;
  json["bulk_density_kg_m3"] = column_bulk_density(column, scene.test.cylinder_radius);
  json["mass_on_base_kg"] = measured.mass_on_base;
  json["peak_height_mm"] = 1e3 * measured.peak_height;
  json["bodies_poured"] = column.bodies.size();
  json["bodies"] = heap.bodies.size();
  json["column_energy_ratio"] = energy_ratio(column, kinds, density);
  json["heap_energy_ratio"] = energy_ratio(heap, kinds, density);
  return json;
}

}  // namespace repose::peer
