#pragma once

#include <string>
#include <vector>

#include "engine/base/input_error.hpp"
#include "sweep/design.hpp"

namespace repose::sweep {

/// Adds a factor to a design's, without its levels. Faults: a name that stands for no number of a case
/// (factor_pointer), and a number that an earlier factor already stands for.
/// @param file, place  where the factor is named
void add_factor(const std::string& name, const std::string& file, const std::string& place,
                std::vector<Factor>& factors, Faults& faults);

}  // namespace repose::sweep
