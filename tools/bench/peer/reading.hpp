#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/scene/scene.hpp"
#include "tools/bench/peer/liggghts_case.hpp"

namespace repose::peer {

/// When the stages of a run began, from what `repose simulate --json` said of it. Rest counts from the
/// opening, and the run ends once it has lasted 20 ms:  t_end = steps Δt,  t_opening = t_end − rest_time − 20
/// ms, good to the half millisecond between two looks at the bodies. Throws InputError where the run did not
/// come to rest.
Schedule schedule_of(const nlohmann::ordered_json& result);

/// Column and heap of a run's folder, measured as Repose measures its own: angle_of_repose_deg,
/// angle_standard_error_deg, reason, bulk_density_kg_m3, mass_on_base_kg, peak_height_mm, bodies,
/// bodies_poured, and kinetic energy per body over m g d of both (column_energy_ratio, heap_energy_ratio).
nlohmann::ordered_json read_run(const Scene& scene, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace repose::peer
