#pragma once

#include <string>
#include <vector>

#include "engine/run/run.hpp"

namespace repose::hostile {

/// What is wrong with how a run ended; empty: nothing. A run that is not `completed` must say why and give no
/// angle; one that is must have a closed ledger and a heap that could lie there, looked at with nothing but
/// its snapshot:
///
/// - angle and flanks between 0 and 90°, errors finite;
/// - bodies that touch another at rest: median kinetic energy below 2 × rest_energy_ratio × m g d;
/// - no body under the base's top, beyond what it could have reached in time, or deep in another or in the
/// base;
/// - no heap higher than its column;
/// - masses: on the base as the bodies that are there, poured within half a particle of what was asked for,
/// none lost
///   that had nowhere to go.
std::vector<std::string> faults_of(const Scene& scene, const RunResult& result);

/// Whether the run itself says that its motion may not be resolved.
bool motion_is_questioned(const RunResult& result);

}  // namespace repose::hostile
