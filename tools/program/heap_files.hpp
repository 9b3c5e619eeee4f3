#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/run/run.hpp"

namespace repose::program {

/// What `simulate --out` leaves in the folder: result.json, heap_{spheres,bodies,walls}.vtp, heap.dump,
/// profile.png and heap.png. Throws std::runtime_error naming what could not be written.
void write_heap_files(const std::filesystem::path& folder, const RunResult& result, const std::string& title,
                      const nlohmann::ordered_json& json);

}  // namespace repose::program
