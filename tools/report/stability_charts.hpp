#pragma once

#include <filesystem>
#include <vector>

#include "engine/stability/stability_map.hpp"

namespace repose::report {

/// Draws the map at the stiffness of the case into a folder, each chart as SVG and PNG, and returns their
/// names without the extension:
///   energy_<test>   energy error against step, a panel an integrator, a line a rolling model, with the bar,
///   the
///                   steps that failed and 30 % of T_R
///   largest_steps   the largest stable step of every method in every experiment, over T_R of the smallest
///                   sphere, over T_R of the equivalent sphere and over √(m/ΣK)
/// Throws std::runtime_error if gnuplot fails.
std::vector<std::string> draw_stability(const StabilityMap& map, const Scene& scene,
                                        const Tolerance& tolerance, const std::filesystem::path& folder);

}  // namespace repose::report
