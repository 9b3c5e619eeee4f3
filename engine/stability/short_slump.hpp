#pragma once

#include <cstdint>

#include "engine/scene/heap_snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "engine/stability/probe.hpp"

namespace repose {

/// The scene's own slump test, smaller: about `bodies` particles in a cylinder and on a base that are shorter
/// and narrower in the same proportion, f = ∛(mass/mass of the scene); times go with √f (Froude). A scene of
/// fewer particles stays as it is. The cylinder keeps room for two and a half of the largest particles beside
/// its axis, and is half as high again, because narrow columns are loose.
Scene shortened(const Scene& scene, int bodies);

/// A column that was poured and has settled, at a step that is sound, and what is so at rest.
struct SettledColumn {
  Scene scene;                         ///< the shortened one that it was poured from, with a sound step
  HeapSnapshot bodies;                 ///< at rest
  double mean_overlap = 0.0;           ///< δ over the mean diameter of the two bodies [-]
  double largest_overlap = 0.0;        ///< δ over the smaller radius [-]
  double elastic_energy = 0.0;         ///< of all contacts [J]
  double stiffness_time = 0.0;         ///< least √(m/ΣK) of its bodies, by the bound of MotionWatch [s]
  double impact_stiffness_time = 0.0;  ///< the same at any look of the pour [s]
  std::string reason;                  ///< why there is none; empty if there is one
  bool interrupted = false;

  [[nodiscard]] bool sound() const { return reason.empty() && !interrupted; }
};

/// Pours and settles it at half the automatic step, or a quarter and an eighth of it where the energy ledger
/// is off by more than a tenth; with type_c, which comes to rest, symplectic Euler and at most e = 0.3.
SettledColumn settle_column(const Scene& shortened, std::uint64_t seed, const std::atomic<bool>* stop);

/// The settled column goes on standing, with the scene's own method and at another step, for kHold times the
/// column's √(m/ΣK). Its tangential springs begin anew. The energy error is over the column's elastic energy;
/// overlaps are compared with those at rest.
Experiment column_experiment(const SettledColumn& column, const Scene& scene, const Tolerance& tolerance,
                             const std::atomic<bool>* stop);
inline constexpr double kHold = 2000.0;

/// The shortened slump whole, from pour to rest or to the end of its time. The energy error is over all that
/// was put in; overlaps are those of its settled column in the mean, and may be deeper by kPackings besides,
/// because another step packs another column. A heap that does not come to rest is not unstable for that.
Experiment slump_experiment(const SettledColumn& column, const Scene& scene, std::uint64_t seed,
                            const Tolerance& tolerance, const std::atomic<bool>* stop);

}  // namespace repose
