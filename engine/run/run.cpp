#include "engine/run/run.hpp"

#include <array>
#include <ctime>

#include "engine/run/warnings.hpp"
#include "engine/scene/canonical.hpp"
#include "engine/slump/slump_test.hpp"

namespace repose {

namespace {

double thread_cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr const char* kEngine = "9";

/// Vector code rounds as its machine does: fused multiplication and the width of its registers are part of a
/// result.
constexpr std::array kInstructionSets = {"avx512", "avx2", "avx", "baseline"};
#if defined(__AVX512F__)
constexpr std::size_t kOwnSet = 0;
#elif defined(__AVX2__) && defined(__FMA__)
constexpr std::size_t kOwnSet = 1;
#elif defined(__AVX__)
constexpr std::size_t kOwnSet = 2;
#else
constexpr std::size_t kOwnSet = 3;
#endif

std::string version_for(std::size_t set) { return std::string(kEngine) + "-" + kInstructionSets[set]; }

/// Angle and responses of a heap at rest, or why it has none.
void measure(RunResult& result, const Scene& scene, const SlumpTestRun& test) {
  const HeapMeasurement& measured = result.measurement = measure_heap(result.heap, scene.measure);
  if (!measured.has_heap) result.outcome = measured.unreadable ? Outcome::unreadable : Outcome::no_heap;
  result.reason = measured.reason;
  result.responses = {.mass_on_base = measured.mass_on_base,
                      .mass_lost = test.pour().total_mass() - measured.mass_on_base,
                      .peak_height = measured.peak_height,
                      .bulk_density = column_bulk_density(test.column(), scene.test.cylinder_radius),
                      .rest_time = test.rest_time(),
                      .reaches_edge = measured.reaches_edge};
}

}  // namespace

std::string engine_version() { return version_for(kOwnSet); }

std::string run_key(const Scene& scene, std::uint64_t seed) { return run_keys(scene, seed).front(); }

std::vector<std::string> run_keys(const Scene& scene, std::uint64_t seed) {
  const std::string run = canonical_text(scene) + "\nseed " + std::to_string(seed) + "\nengine ";
  std::vector<std::string> keys = {digest(run + engine_version())};
  for (std::size_t set = 0; set < kInstructionSets.size(); ++set)
    if (set != kOwnSet) keys.push_back(digest(run + version_for(set)));
  return keys;
}

RunResult run_slump_test(const Scene& scene, std::uint64_t seed, const RunOptions& options) {
  const double begin = thread_cpu_time();
  const double helped_before = options.crew ? options.crew->helped_s() : 0.0;
  SlumpTestRun test(scene, seed, options);
  test.run();

  RunResult result;
  result.outcome = test.outcome();
  result.reason = test.reason();
  result.heap = test.simulation().snapshot();
  result.motion = test.diagnosis();
  result.energy = test.simulation().ledger();
  if (result.outcome == Outcome::completed) measure(result, scene, test);
  result.warnings = scene_warnings(scene);
  for (const auto& more : {run_warnings(scene, test), result.measurement.warnings})
    result.warnings.insert(result.warnings.end(), more.begin(), more.end());
  const double helped = options.crew ? options.crew->helped_s() - helped_before : 0.0;
  result.cost = {thread_cpu_time() - begin + helped, test.simulation().steps(), test.simulation().dt()};
  result.bodies = test.pour().total_bodies();
  for (const ParticleDraw& particle : test.pour().particles())
    result.spheres +=
        static_cast<long>(scene.particles.shapes[static_cast<std::size_t>(particle.shape)].spheres.size());
  result.seed = seed;
  result.run_key = run_key(scene, seed);
  return result;
}

}  // namespace repose
