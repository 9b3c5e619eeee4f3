#pragma once

#include <string>

#include "fit/inversion.hpp"
#include "fit/power_law.hpp"

namespace repose::program {

/// The equation with its errors, in a few lines.
std::string in_words(const fit::PowerLaw& law);

/// The curve of (μs, μr) that give the angle as a small table with its bands; empty where there is a
/// solution.
std::string curve_in_words(const fit::Inversion& inversion);

}  // namespace repose::program
