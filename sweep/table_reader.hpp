#pragma once

#include <filesystem>

#include "engine/base/input_error.hpp"
#include "sweep/design.hpp"

namespace repose::sweep {

/// Reads the CSV of a table design into factors and rows: a column for each factor, named as in a case, and a
/// column `replicate` (1, 2, …) where the table repeats points. Faults: what read_csv finds; a column of
/// another name; no factor; no rows; a cell that is not a number; a replicate that is not a positive integer;
/// two rows of the same point (and replicate).
void read_design_table(const std::filesystem::path& file, Design& design, Faults& faults);

}  // namespace repose::sweep
