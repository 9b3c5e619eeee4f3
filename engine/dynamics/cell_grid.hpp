#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace repose {

struct BodyPair {
  int i = 0;  ///< i < j
  int j = 0;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// Spheres to search among: centres and radii, one entry each [m].
struct SearchSpheres {
  std::span<const double> x, y, z, radius;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// All pairs of spheres with a gap below `skin`, each once, sorted: |x_i − x_j| < r_i + r_j + skin.
/// A uniform grid with cells of the largest diameter plus the skin; where strays would make it larger than a
/// few cells a body, cells grow instead. Cost is linear in the number of spheres for sizes of one order.
/// Requires finite coordinates.
std::vector<BodyPair> near_pairs(const SearchSpheres& spheres, double skin);

}  // namespace repose
