#pragma once

#include <string>

#include "sweep/store.hpp"

namespace repose::sweep {

/// The four flanks of a heap as JSON text: the lines and the points that they were fitted to, in metres and
/// radians. What is not finite becomes null.
std::string flanks_to_json(const Flanks& flanks);
/// Reverses it; null becomes NaN. Throws nlohmann::json::exception on other text.
Flanks flanks_from_json(const std::string& text);

}  // namespace repose::sweep
