#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/stability/cliff.hpp"
#include "engine/stability/method.hpp"

namespace repose {

enum class StabilityTest { elastic_pair, settled_column, flat_clump, slump };
inline constexpr std::array kStabilityTests{StabilityTest::elastic_pair, StabilityTest::settled_column,
                                            StabilityTest::flat_clump, StabilityTest::slump};
/// "elastic_pair", …
std::string_view name_of(StabilityTest test);

struct MapOptions {
  /// Stiffness scales, as multiples of the scene's own; the scene's own, 1, is always measured.
  std::vector<double> scales{1.0, 0.1, 0.01};
  double precision = 0.05;  ///< of a cliff [-]
  int bodies = 100;         ///< about as many in the column and the slump
  Tolerance tolerance;
  std::uint64_t seed = 1;
  int threads = 0;                          ///< experiments at a time; 0: one a processor
  const std::atomic<bool>* stop = nullptr;  ///< set: what is under way is given up, what is done is returned
  /// Called as experiments end, one call at a time, from any thread.
  std::function<void(int done, int all)> on_progress;
};

/// One experiment with one method at one stiffness. Times are those of its stiffness.
struct MapRow {
  StabilityTest test = StabilityTest::elastic_pair;
  Method method;
  bool any_rolling = false;      ///< the rolling model does not enter (elastic_pair)
  double stiffness_scale = 1.0;  ///< of the scene, absolute
  Cliff cliff;
  double smallest_rayleigh = 0.0;    ///< T_R of the smallest sphere [s]
  double equivalent_rayleigh = 0.0;  ///< T_R of the sphere of the smallest particle's volume [s]
  double stiffness_time = 0.0;       ///< least √(m/ΣK) of a body in this experiment [s]
  double automatic = 0.0;            ///< what "auto" gives with this method [s]
  std::string reason;                ///< why there is no cliff, or empty

  [[nodiscard]] bool measured() const { return reason.empty(); }
};

/// Largest steps of the scene's own method and stiffness, and what follows.
struct Recommendation {
  Method method;
  StabilityTest limit = StabilityTest::slump;  ///< the test with the least cliff
  double largest_stable = 0.0;                 ///< of it [s]
  double step = 0.0;                           ///< largest_stable over kSafetyMargin [s]
  double automatic = 0.0;                      ///< what "auto" gives [s]
  double own = 0.0;                            ///< the case's step [s]
  double smallest_rayleigh = 0.0;              ///< [s]
};
/// A slump has more bodies, other seeds and rarer moments than the experiments.
inline constexpr double kSafetyMargin = 2.0;

struct StabilityMap {
  std::vector<MapRow>
      rows;  ///< by test, stiffness (as given), method; of an interrupted map those that are done
  std::optional<Recommendation> recommendation;  ///< where every test of the scene's own method has a cliff
  std::string reason;                            ///< why there is none
  bool interrupted = false;
};

/// Every integrator and rolling model at every stiffness through all four experiments. The same bits for any
/// number of threads.
StabilityMap map_stability(const Scene& scene, const MapOptions& options);

}  // namespace repose
