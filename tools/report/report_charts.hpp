#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "fit/inversion.hpp"
#include "fit/power_law.hpp"
#include "fit/response_table.hpp"

namespace repose::report {

/// Angles of the equation against simulated ones, with the line of agreement and the worst error on both
/// sides.
/// @param used  the rows that the law was fitted to, not empty
void draw_predicted_against_simulated(const std::filesystem::path& svg, const fit::PowerLaw& law,
                                      const std::vector<fit::Observation>& used);

/// Both frictions vary, so that the angle is a matter of two.
bool spans_plane(const fit::PowerLaw& law);

/// What the angle says about friction. Where μs and μr both vary: their plane, with the curve of the measured
/// angle and its band, lines of other angles, and the pairs that were simulated. Where one of them varies:
/// the angle over it.
/// @param inversion  may be missing: the plane is then drawn without a measured angle
/// Requires a law in which μs or μr is identified.
void draw_friction(const std::filesystem::path& svg, const fit::PowerLaw& law,
                   const std::optional<fit::Inversion>& inversion, const std::vector<fit::Observation>& used);

}  // namespace repose::report
