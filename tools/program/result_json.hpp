#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/run/run.hpp"

namespace repose::program {

/// A slump test as `simulate --json` and result.json give it. Angles are null unless the test is `completed`;
/// so is every number that is not finite.
nlohmann::ordered_json to_json(const RunResult& result, const std::string& title);

/// The same in a few lines for people.
std::string in_words(const RunResult& result);

}  // namespace repose::program
