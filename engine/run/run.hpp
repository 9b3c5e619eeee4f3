#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/dynamics/energy_ledger.hpp"
#include "engine/measure/heap_measurement.hpp"
#include "engine/scene/scene.hpp"
#include "engine/slump/motion_watch.hpp"
#include "engine/slump/outcome.hpp"

namespace repose {

/// What there is to measure of a run that came to rest; of any other all are absent (NaN, false).
struct Responses {
  static constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
  double mass_on_base = kAbsent;  ///< [kg]
  double mass_lost = kAbsent;     ///< poured and not on the base [kg]
  double peak_height = kAbsent;   ///< [m]
  double bulk_density = kAbsent;  ///< of the settled column before opening [kg/m³]
  double rest_time = kAbsent;     ///< from the opening to rest [s]
  bool reaches_edge = false;      ///< the base's edge cuts the heap (HeapMeasurement)
};

struct Cost {
  double cpu = 0.0;  ///< CPU time of all threads, without their waiting for each other [s]
  long steps = 0;
  double time_step = 0.0;  ///< Δt [s]
};

struct RunResult {
  Outcome outcome = Outcome::completed;
  std::string reason;  ///< what happened and what to do, empty if `completed`
  /// What makes the result worth less than it looks, each name once: of the scene (scene_warnings.hpp), then
  /// of the run.
  std::vector<Warning> warnings;
  MotionDiagnosis motion;
  HeapMeasurement measurement;
  EnergyLedger energy;  ///< until the end
  Responses responses;
  Cost cost;
  int bodies = 0;    ///< poured
  long spheres = 0;  ///< of all bodies poured
  std::uint64_t seed = 0;
  std::string run_key;
  HeapSnapshot heap;  ///< at the end
};

/// One slump test: (scene, seed) → result, the same bits whatever runs beside it and whoever helps. Bad
/// physics ends in an outcome, not in an exception.
RunResult run_slump_test(const Scene& scene, std::uint64_t seed, const RunOptions& options = {});

/// 32 hexadecimal digits over everything that can change a result: the scene with its shapes, the seed, the
/// engine's version and instruction set.
std::string run_key(const Scene& scene, std::uint64_t seed);

/// The same: run_key() first, then the keys of the same run by builds of this engine for other instruction
/// sets. Their results differ by rounding alone, so that they are as good as this build's.
std::vector<std::string> run_keys(const Scene& scene, std::uint64_t seed);

/// Version of the engine as it enters the run key, "9-avx2": a number that changes whenever results may
/// change, and the instruction set.
std::string engine_version();

}  // namespace repose
