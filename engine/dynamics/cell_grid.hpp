#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace repose {

struct BodyPair {
  int i = 0;  ///< i > j
  int j = 0;
  friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// Spheres to search among: centres and radii, one entry each [m].
struct SearchSpheres {
  std::span<const double> x, y, z, radius;
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// A uniform grid that finds the pairs of spheres with a gap below `skin`: |x_i − x_j| < r_i + r_j + skin.
/// Its cells are of the largest diameter plus the skin; where strays would make it larger than a few cells a
/// body, cells grow instead. Cost is linear in the number of spheres for sizes of one order. Requires finite
/// coordinates, which the grid looks at again: they have to outlive it.
class CellGrid {
 public:
  CellGrid(const SearchSpheres& spheres, double skin);

  /// Appends the pairs of sphere i with spheres of smaller numbers, sorted.
  void append_pairs_of(std::size_t i, std::vector<BodyPair>& pairs) const;
  /// The same, and to `above` the pairs with spheres of greater numbers whose flag is 0, in any order.
  void append_pairs_of(std::size_t i, std::span<const std::uint8_t> flags, std::vector<BodyPair>& pairs,
                       std::vector<BodyPair>& above) const;

 private:
  /// visit(j) for every sphere j near sphere i, which itself is among them.
  template <class Visit>
  void each_near(std::size_t i, Visit visit) const;
  void choose_cells(double edge);
  void sort_into_cells();
  [[nodiscard]] int along(int axis, double coordinate) const;
  [[nodiscard]] int index(int cx, int cy, int cz) const { return (cz * cells_[1] + cy) * cells_[0] + cx; }

  SearchSpheres spheres_;
  double skin_;
  std::array<double, 3> low_{};
  std::array<int, 3> cells_{1, 1, 1};
  double edge_ = 1.0;
  // Members of cell c are order_[begin_[c]] … order_[begin_[c+1]−1], ascending.
  std::vector<int> begin_, order_;
};

}  // namespace repose
