#include "engine/stability/stability_map.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>

#include "engine/dynamics/time_step.hpp"
#include "engine/scene/particle_sizes.hpp"
#include "engine/stability/elastic_pair.hpp"
#include "engine/stability/flat_clump.hpp"
#include "engine/stability/short_slump.hpp"

namespace repose {

namespace {

/// Of the least √(m/ΣK), where the walk begins: far below every cliff of a symplectic step, and low enough
/// for the curve of errors to show how they fall.
constexpr double kStart = 0.25, kStartOfPair = 1.0 / 32.0, kStartOfSlump = 0.5;

/// A scene at one stiffness, its slump shortened, and the column that is poured from that.
struct Stiffness {
  Scene scene;
  Scene small;
  SettledColumn column;
};

Stiffness at_scale(Scene scene, double scale, int bodies) {
  scene.numerics.stiffness_scale *= scale;
  Scene small = shortened(scene, bodies);
  return {std::move(scene), std::move(small), {}};
}

/// The work of a map, cut into independent pieces.
class Mapping {
 public:
  Mapping(const Scene& scene, const MapOptions& options) : scene_(scene), options_(options) {
    std::vector<double> scales = options.scales;
    if (std::ranges::find(scales, 1.0) == scales.end()) scales.insert(scales.begin(), 1.0);
    for (const double scale : scales) stiffnesses_.push_back(at_scale(scene, scale, options.bodies));
    methods_ = all_methods();
    const Method own = method_of(scene);
    if (std::ranges::find(methods_, own) == methods_.end()) methods_.push_back(own);
    for (const StabilityTest test : kStabilityTests) add_rows(test);
    done_.assign(rows_.size(), 0);
  }

  StabilityMap run() {
    all_ = static_cast<int>(rows_.size() + stiffnesses_.size());
    if (options_.on_progress) options_.on_progress(0, all_);
    for_each(stiffnesses_.size(), [this](std::size_t k) {
      Stiffness& at = stiffnesses_[k];
      at.column = settle_column(at.small, options_.seed, options_.stop);
    });
    // The longest first: the slumps stand last.
    for_each(rows_.size(), [this](std::size_t k) { measure(rows_.size() - 1 - k); });
    return result();
  }

 private:
  void add_rows(StabilityTest test) {
    for (std::size_t k = 0; k < stiffnesses_.size(); ++k)
      for (const Method& method : methods_) {
        const bool any_rolling = test == StabilityTest::elastic_pair;
        const Method first{method.integrator, RollingModel::type_a, RollingTorque::limited};
        if (any_rolling && !(method == first)) continue;
        MapRow row;
        row.test = test;
        row.method = method;
        row.any_rolling = any_rolling;
        const Scene& scene = stiffnesses_[k].scene;
        row.stiffness_scale = scene.numerics.stiffness_scale;
        row.smallest_rayleigh = rayleigh_time(smallest_sphere(scene.particles), scene);
        row.equivalent_rayleigh = rayleigh_time(equivalent_sphere(scene.particles), scene);
        row.automatic = automatic_time_step(with_method(scene, method));
        rows_.push_back(row);
        stiffness_of_.push_back(k);
      }
  }

  [[nodiscard]] bool stopped() const { return options_.stop && options_.stop->load(); }

  /// No exception may leave the body of a parallel loop.
  template <class Piece>
  void for_each(std::size_t count, Piece piece) {
    const int threads = options_.threads > 0 ? options_.threads : omp_get_max_threads();
    const auto pieces = static_cast<std::int64_t>(count);
#pragma omp parallel for schedule(monotonic : dynamic, 1) num_threads(threads)
    for (std::int64_t k = 0; k < pieces; ++k) {
      if (stopped()) continue;
      std::exception_ptr thrown;
      try {
        piece(static_cast<std::size_t>(k));
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      if (thrown && !fault_) fault_ = thrown;
      ++finished_;
      if (options_.on_progress && !fault_) options_.on_progress(finished_, all_);
    }
    if (fault_) std::rethrow_exception(fault_);
  }

  /// The experiment of a row and the part of its √(m/ΣK), which is noted, where its walk begins.
  [[nodiscard]] std::pair<Experiment, double> experiment_of(MapRow& row, const Stiffness& at) const {
    const Tolerance& tolerance = options_.tolerance;
    const Scene scene = with_method(at.scene, row.method), small = with_method(at.small, row.method);
    switch (row.test) {
      case StabilityTest::elastic_pair:
        row.stiffness_time = elastic_pair(scene).stiffness_time;
        return {elastic_pair_experiment(scene, tolerance), kStartOfPair};
      case StabilityTest::settled_column:
        row.stiffness_time = at.column.stiffness_time;
        return {column_experiment(at.column, small, tolerance, options_.stop), kStart};
      case StabilityTest::flat_clump: {
        const FlatMotion sound = flat_motion(scene);
        row.stiffness_time = sound.stiffness_time;
        return {flat_clump_experiment(scene, sound, tolerance, options_.stop), kStart};
      }
      case StabilityTest::slump:
        row.stiffness_time = at.column.impact_stiffness_time;
        return {slump_experiment(at.column, small, options_.seed, tolerance, options_.stop), kStartOfSlump};
    }
    return {};
  }

  void measure(std::size_t index) {
    MapRow& row = rows_[index];
    const Stiffness& at = stiffnesses_[stiffness_of_[index]];
    const bool of_column = row.test == StabilityTest::settled_column || row.test == StabilityTest::slump;
    if (of_column && !at.column.sound()) {
      row.reason = at.column.reason;
      done_[index] = at.column.interrupted ? 0 : 1;
      return;
    }
    const auto [experiment, start] = experiment_of(row, at);
    if (std::isfinite(row.stiffness_time)) {
      row.cliff = find_cliff(experiment, {start * row.stiffness_time, options_.precision});
      if (!row.cliff.interrupted) explain(row);
    } else {
      row.reason = "nothing touched";
    }
    done_[index] = row.cliff.interrupted ? 0 : 1;
  }

  static void explain(MapRow& row) {
    const std::vector<Probe>& probes = row.cliff.probes;
    if (!(row.cliff.stable > 0.0))
      row.reason = fmt::format("no step down to {:.3g} s is stable", probes.front().step);
    else if (!(row.cliff.unstable > 0.0))
      row.reason = fmt::format("no step up to {:.3g} s is unstable", probes.back().step);
  }

  StabilityMap result() {
    StabilityMap map;
    map.interrupted = stopped();
    if (!map.interrupted) recommend(map);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (done_[k]) map.rows.push_back(std::move(rows_[k]));
    return map;
  }

  /// The least of the scene's own cliffs.
  void recommend(StabilityMap& map) const {
    Recommendation found;
    found.method = method_of(scene_);
    found.automatic = automatic_time_step(scene_);
    found.own = time_step(scene_);
    found.smallest_rayleigh = rayleigh_time(smallest_sphere(scene_.particles), scene_);
    for (const MapRow& row : rows_) {
      const bool own =
          row.any_rolling ? row.method.integrator == found.method.integrator : row.method == found.method;
      if (!own || row.stiffness_scale != scene_.numerics.stiffness_scale) continue;
      if (!row.measured()) {
        map.reason = fmt::format("{}: {}", name_of(row.test), row.reason);
        return;
      }
      if (found.largest_stable > 0.0 && row.cliff.stable >= found.largest_stable) continue;
      found.largest_stable = row.cliff.stable;
      found.limit = row.test;
    }
    found.step = found.largest_stable / kSafetyMargin;
    map.recommendation = found;
  }

  const Scene& scene_;
  const MapOptions& options_;
  std::vector<Stiffness> stiffnesses_;
  std::vector<Method> methods_;
  std::vector<MapRow> rows_;
  std::vector<std::size_t> stiffness_of_;
  std::vector<char> done_;

  std::mutex mutex_;
  int finished_ = 0;
  int all_ = 0;
  std::exception_ptr fault_;
};

}  // namespace

std::string_view name_of(StabilityTest test) {
  switch (test) {
    case StabilityTest::elastic_pair:
      return "elastic_pair";
    case StabilityTest::settled_column:
      return "settled_column";
    case StabilityTest::flat_clump:
      return "flat_clump";
    case StabilityTest::slump:
      return "slump";
  }
  return "unknown";
}

StabilityMap map_stability(const Scene& scene, const MapOptions& options) {
  return Mapping(scene, options).run();
}

}  // namespace repose
