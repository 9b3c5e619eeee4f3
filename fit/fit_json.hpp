#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fit/inversion.hpp"
#include "fit/power_law.hpp"

namespace repose::fit {

/// A fit as an object: C, a, b, c; standard_error, interval_95 and identified by parameter; correlation and
/// covariance as 4 × 4 rows in the order of `parameters`; worst_error_deg, worst_point, rms_error_deg,
/// r_squared, points, excluded, domain and what an inversion needs. What is not known is null.
nlohmann::json to_json(const PowerLaw& law);

/// The law of a saved fit. Needed are C, a, b, c and domain (e_pp, mu_s, mu_r, each [low, high]), so that an
/// equation of the literature can be written by hand; without covariance and error its bands are those of the
/// measured angle alone. Keys that are not known are passed over.
/// @param source  how messages name the file
/// Throws BadSavedFit with every fault.
PowerLaw power_law_from_json(const nlohmann::json& json, const std::string& source);

/// An inversion as an object: angle_deg, sigma_deg, e_pp, level_set (mu_s, mu_r and the 95 % band of each),
/// identifiable, reachable_deg and, where enough is fixed, solution.
nlohmann::json to_json(const Inversion& inversion);

}  // namespace repose::fit
