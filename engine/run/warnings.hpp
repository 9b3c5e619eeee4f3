#pragma once

#include <vector>

#include "engine/base/warning.hpp"
#include "engine/scene/scene.hpp"
#include "engine/slump/slump_test.hpp"

namespace repose {

/// What a scene alone says of the worth of its result, before anything runs (README.md holds the thresholds
/// and where they come from): high_friction, no_friction, no_rolling_friction, no_restitution,
/// full_restitution, tiny_sphere, size_ratio, coarse_opening.
std::vector<Warning> scene_warnings(const Scene& scene);

/// What a run says of its own result: jitter, coarse_step, energy_error, soft_contacts, spilled,
/// slow_opening, fast_opening.
std::vector<Warning> run_warnings(const Scene& scene, const SlumpTestRun& run);

}  // namespace repose
