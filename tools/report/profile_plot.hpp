#pragma once

#include <filesystem>
#include <string>

#include "engine/measure/heap_measurement.hpp"

namespace repose {

/// Draws the side profiles of a heap with gnuplot: the tops along +x and −x in one panel, along +y and −y in
/// the other, with the fitted lines and their angles. Throws std::runtime_error if gnuplot fails.
void plot_profiles(const HeapMeasurement& measurement, const std::filesystem::path& png,
                   const std::string& title);

}  // namespace repose
