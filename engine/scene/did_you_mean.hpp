#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace repose {

/// The candidate that a mistyped name most likely stands for, or "" where none is close: the one with the
/// fewest edits, at most a third of the name's length, whatever the case of the letters; else one that begins
/// like the name or the other way round ("density" for "density_kg_m3").
std::string_view closest(std::string_view name, const std::vector<std::string_view>& candidates);

/// `; did you mean "density_kg_m3"?`, or "" where no candidate is close.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace repose
