#pragma once

#include <optional>
#include <string>

#include "engine/base/input_error.hpp"

namespace repose {

/// A unit of length.
struct LengthUnit {
  std::string name;     ///< m, cm, mm, um or in
  double metres = 0.0;  ///< of one unit
};

/// The unit of a word in small letters: m, cm, mm, um, in, written out (millimetres, millimeter, micron,
/// inches …) or with a Greek mu; nothing for another word.
std::optional<LengthUnit> length_unit(const std::string& word);

/// The name of the unit that is so many metres; "unit" where none of them is.
std::string unit_name(double metres);

/// The unit that a header or comment names after "unit" or "units" and '=' or ':', as in "units=mm" or
/// "# File units : millimetres"; nothing where none is named.
/// A word that is no unit, and units that differ, are faults under the name `file`.
std::optional<LengthUnit> named_unit(const std::string& header, const std::string& file, Faults& faults);

}  // namespace repose
