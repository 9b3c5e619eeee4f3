#pragma once

#include <vector>

#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// A body's highest point, where that point belongs to the heap's free surface.
struct SurfaceTop {
  double x = 0.0;         ///< [m]
  double y = 0.0;         ///< [m]
  double z = 0.0;         ///< [m]
  double diameter = 0.0;  ///< equivalent diameter of its body [m]
};

/// The free surface of a heap: the highest points of those bodies that have no higher top near, that is
/// within 0.7 of the mean diameter of the two, measured horizontally. The share of 0.7 is the one at which
/// the mean depth of the tops under the true surface does not change with the slope's height: nearer, and
/// deep tops seen through gaps are counted where bodies are many but not at the tip; farther, and low tops go
/// missing on steep flanks.
std::vector<SurfaceTop> free_surface(const HeapSnapshot& heap, const std::vector<int>& members);

}  // namespace repose
