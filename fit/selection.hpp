#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "fit/power_law.hpp"
#include "fit/solver.hpp"

namespace repose::fit {

/// The factors in the order of the exponents a, b, c.
enum class Factor { e, mu_r, mu_s };
inline constexpr std::array<Factor, 3> kFactors = {Factor::e, Factor::mu_r, Factor::mu_s};
/// "e_pp", "mu_r", "mu_s": the names that a user types.
const char* name_of(Factor factor);
double value_of(const Factors& factors, Factor factor);
void set(Factors& factors, Factor factor, double value);
const Range& range_of(const Domain& domain, Factor factor);

/// Which rows of a table a power law can take and which exponents they determine.
struct Selection {
  std::vector<Observation> used;
  std::vector<Excluded> excluded;
  std::vector<Factor> varying;  ///< in the order of kFactors
  int distinct_points = 0;      ///< rows of `used` that differ in their factors or their test
  std::vector<int> point_of;    ///< number of the distinct point of each row of `used`
  int places = 0;               ///< rows of `used` that differ in their factors
  std::vector<int> place_of;    ///< number of the place of each
};

/// Sorts the rows. Throws Unusable where what is left cannot be fitted (see fit_power_law).
Selection select_points(std::span<const Observation> table);

/// The logarithms of the varying factors and the angles.
PowerProblem problem_of(const Selection& selection);

}  // namespace repose::fit
