#pragma once

#include <filesystem>
#include <string>

namespace repose::sweep {

/// The runs of a study as a CSV, one line a run, by point and replicate: run_key, point, replicate, seed,
/// e_pp, mu_s, mu_r, a column for each other factor that any run was made with, outcome, reason, angle_deg
/// and its standard error, the four angles, the other responses, the cost, version and time.
///
/// Numbers have all their digits. Cells are empty where there is nothing: angles of runs that did not
/// complete, the point of a run that the design no longer has. A factor that a run was made without has the
/// value of the case. Runs that a later version of the program has made again are left out. Throws InputError
/// as open_study() does.
std::string study_as_csv(const std::filesystem::path& folder);

/// Writes it to a file, which is replaced whole, or to a pipe or device. Throws InputError where the file
/// cannot be written.
void export_csv(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace repose::sweep
