#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/shape/clump.hpp"
#include "engine/shape/mesh.hpp"
#include "engine/shape/scan_table.hpp"

namespace repose::program {

// Pictures of particle shapes as PNG, drawn by gnuplot. Each throws std::runtime_error where gnuplot is
// missing or fails, and makes the picture's folder.

/// Equivalent surface against surface with the line through it (article Figure 4).
void draw_sphericity(const std::filesystem::path& picture, const ScanTable& table);

/// The mesh and the clumps of it side by side, seen alike (article Figure 5).
void draw_clumps(const std::filesystem::path& picture, const Mesh& mesh, const std::vector<Clump>& clumps);

struct ErrorPoint {
  int spheres = 0;
  double volume_error = 0.0;   ///< [-]
  double eit_error = 0.0;      ///< [-]
  double mean_distance = 0.0;  ///< over the equivalent diameter [-]
};
/// Errors against the number of spheres (article Figure 6).
void draw_errors(const std::filesystem::path& picture, const std::string& name,
                 const std::vector<ErrorPoint>& points);

}  // namespace repose::program
