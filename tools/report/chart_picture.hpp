#pragma once

#include <filesystem>

#include "chart/chart.hpp"

namespace repose::report {

/// Cost of a run (logarithmic) against error (square-root scale) of every rung that completed, with standard
/// errors; rungs of one kind joined with what they depart from; the Pareto front; the scatter of one
/// run shaded; rungs that did not complete named with their outcome. As SVG or PNG, by the file's extension.
/// Throws std::runtime_error where gnuplot is missing or fails.
void draw_chart(const std::filesystem::path& file, const chart::Chart& chart);

}  // namespace repose::report
