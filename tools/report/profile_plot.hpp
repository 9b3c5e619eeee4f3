#pragma once

#include <filesystem>
#include <string>

#include "engine/measure/heap_measurement.hpp"
#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// Draws the side profiles of a heap with gnuplot: the tops along +x and −x in one panel, along +y and −y in
/// the other, with the fitted lines and their angles. Throws std::runtime_error if gnuplot fails.
void plot_profiles(const HeapMeasurement& measurement, const std::filesystem::path& png,
                   const std::string& title);

/// Draws a snapshot seen from the side and a little above, spheres shaded and hidden by those before them.
void plot_heap(const HeapSnapshot& heap, const std::filesystem::path& png);

}  // namespace repose
