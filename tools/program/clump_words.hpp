#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/shape/clump_generator.hpp"
#include "engine/shape/mesh_file.hpp"

namespace repose::program {

/// The errors of a clump as `clump --json` names them.
nlohmann::ordered_json errors_json(const GeneratedClump& made);

/// What `clump --json` says of a clump: spheres, errors, mass properties for a density in kg/m³, and the mesh
/// that it was made for, with its unit and who says it.
nlohmann::ordered_json clump_json(const GeneratedClump& made, double density, const MeshFromFile& source);

/// The same in a few lines for people.
std::string clump_in_words(const GeneratedClump& made, const MeshFromFile& source);

}  // namespace repose::program
