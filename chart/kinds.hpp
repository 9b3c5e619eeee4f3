#pragma once

#include <string>
#include <vector>

#include "sweep/ladder.hpp"

namespace repose::chart {

/// What sets each rung apart from the others: the last parts of the pointers that it sets itself, joined by
/// "+", and "shapes" for all of the particles' shapes. The working point is of the kind "".
std::vector<std::string> kinds_of(const std::vector<sweep::Variant>& rungs);

}  // namespace repose::chart
