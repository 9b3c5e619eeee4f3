#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/stability/stability_map.hpp"

namespace repose::program {

/// Every row of a map as a line: test, method, stiffness, largest stable step with its fractions, what fails
/// beyond.
std::string stability_csv(const StabilityMap& map);

/// Every step that was tried, as a line: energy error, overlap and what failed.
std::string energy_error_csv(const StabilityMap& map);

/// What --json prints and stability.json holds.
nlohmann::ordered_json to_json(const StabilityMap& map, const Scene& scene);

/// Tables of the largest stable steps at each stiffness, and what to choose.
std::string in_words(const StabilityMap& map, const Scene& scene);

}  // namespace repose::program
