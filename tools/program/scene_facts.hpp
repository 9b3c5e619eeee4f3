#pragma once

#include <vector>

#include "engine/scene/scene.hpp"
#include "tools/report/study_report.hpp"

namespace repose::program {

/// What was simulated, for people: particles, walls, contact, test, numerics.
std::vector<report::FactGroup> facts_of(const Scene& scene);

}  // namespace repose::program
