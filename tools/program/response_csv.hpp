#pragma once

#include <filesystem>
#include <vector>

#include "fit/response_table.hpp"

namespace repose::program {

/// A table of responses from a CSV with the columns e_pp, mu_s, mu_r, angle_deg (others are ignored but for
/// `replicate`, `angle_standard_error_deg` and `outcome`).
///
/// A row without an angle (empty, "nan", "na") or with an outcome other than `completed` is kept with the
/// reason why a fit leaves it out. Throws InputError with every fault: no such file, a column missing, a cell
/// that is no number (each with its line), no rows.
std::vector<fit::Observation> read_response_csv(const std::filesystem::path& file);

}  // namespace repose::program
