#pragma once

#include <string>
#include <vector>

#include "sweep/ladder.hpp"

namespace repose::chart {

/// What sets each rung apart from the others: the last parts of the pointers that it sets, joined by "+", and
/// "shapes" for all of the particles' shapes. A value that more than half of the rungs share counts for
/// nothing: where a ladder stands around a working point, its rungs are of the kind of what they change
/// there, and the working point itself of the kind "".
std::vector<std::string> kinds_of(const std::vector<sweep::Variant>& rungs);

}  // namespace repose::chart
