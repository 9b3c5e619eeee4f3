#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart/differences.hpp"

namespace repose::chart {

/// A rung that may take part in a combination: all its runs completed, and it is cheaper than the reference.
struct Candidate {
  std::string name;
  std::vector<std::string> pointers;  ///< what it sets itself
  Differences angle;                  ///< to the reference [degrees]
  double cost_ratio = 1.0;            ///< its cost over the reference's
};

/// Rungs set at once, on the working point where there is one.
struct Combination {
  std::vector<std::size_t> rungs;  ///< of the candidates, ascending; empty: the working point itself
  double cost_ratio = 1.0;         ///< expected: the product of theirs
  Judgement predicted;             ///< of the sum of their differences
};

/// "rain + stiffness 0.01", or "working point".
std::string name_of(const Combination& combination, const std::vector<Candidate>& candidates);

/// Whether two rungs set the same thing: the same pointer, one below the other, or its rival (rival_keys()).
bool exclude_each_other(const Candidate& a, const Candidate& b);

/// Most combinations that are looked at.
inline constexpr std::size_t kMostCombinations = 1'000'000;

/// Every combination of rungs that do not exclude each other that is cheaper than the reference and whose
/// predicted error is below `limit` [degrees] with 95 % confidence, the cheapest first. The differences are
/// summed run by run, so that the noise of the reference, which all of them share, counts as often as it
/// occurs. On a working point, itself one of the combinations, a rung adds its difference to that, and
/// multiplies the cost by its ratio to that. Throws std::length_error beyond kMostCombinations.
std::vector<Combination> combinations_within(double limit, const std::vector<Candidate>& candidates,
                                             const std::optional<Candidate>& working_point = std::nullopt);

/// The index of the next combination to try after one of `cost_ratio` has failed: at least kDearer times as
/// dear, because its neighbours differ little from it. combinations.size() where there is none.
std::size_t next_after(const std::vector<Combination>& combinations, double cost_ratio);
inline constexpr double kDearer = 1.15;

}  // namespace repose::chart
