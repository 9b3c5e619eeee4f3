#pragma once

#include <cstdint>
#include <string>

#include "engine/measure/heap_measurement.hpp"
#include "engine/scene/scene.hpp"
#include "engine/slump/outcome.hpp"

namespace repose {

struct Responses {
  double mass_on_base = 0.0;  ///< [kg]
  double peak_height = 0.0;   ///< [m]
  double bulk_density = 0.0;  ///< of the settled column before opening [kg/m³]
  double rest_time = 0.0;     ///< from the opening to rest [s]
};

struct Cost {
  double cpu = 0.0;  ///< CPU time [s]
  long steps = 0;
  double time_step = 0.0;  ///< Δt [s]
};

struct RunResult {
  Outcome outcome = Outcome::completed;
  std::string reason;  ///< what happened and what to do, empty if `completed` without remark
  HeapMeasurement measurement;
  Responses responses;
  Cost cost;
  int bodies = 0;    ///< poured
  long spheres = 0;  ///< of all bodies poured
  std::uint64_t seed = 0;
  std::string run_key;
  HeapSnapshot heap;  ///< at the end
};

/// One slump test: (scene, seed) → result, the same bits whatever runs beside it. Bad physics ends in an
/// outcome, not in an exception.
RunResult run_slump_test(const Scene& scene, std::uint64_t seed, const RunOptions& options = {});

/// 32 hexadecimal digits over everything that can change a result: the scene with its shapes, the seed, the
/// engine's version and instruction set.
std::string run_key(const Scene& scene, std::uint64_t seed);

/// Version of the engine as it enters the run key: changes whenever results may change.
std::string engine_version();

}  // namespace repose
