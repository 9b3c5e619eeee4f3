#pragma once

#include <filesystem>

#include "verification/table/plot.hpp"

namespace repose::verification {

/// Writes a plot into a folder: FILE.csv, columns series,x,y, and FILE.svg by gnuplot. Throws
/// std::runtime_error where gnuplot fails or a file cannot be written.
void write_plot(const Plot& plot, const std::filesystem::path& folder);

}  // namespace repose::verification
