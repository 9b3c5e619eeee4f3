#include "engine/dynamics/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

CellGrid::CellGrid(const SearchSpheres& spheres, double skin) : spheres_(spheres), skin_(skin) {
  if (spheres_.size() == 0) return;
  choose_cells(2.0 * *std::max_element(spheres.radius.begin(), spheres.radius.end()) + skin);
  sort_into_cells();
}

void CellGrid::choose_cells(double edge) {
  std::array<double, 3> size{};
  const std::array coordinates{spheres_.x, spheres_.y, spheres_.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(coordinates[axis].begin(), coordinates[axis].end());
    low_[axis] = *low;
    size[axis] = *high - *low;
  }
  const double most_cells = 4.0 * static_cast<double>(spheres_.size()) + 64.0;
  for (edge_ = edge;; edge_ *= 1.5) {
    double cells = 1.0;
    for (const double length : size) cells *= std::floor(length / edge_) + 1.0;
    if (cells <= most_cells) break;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) cells_[axis] = static_cast<int>(size[axis] / edge_) + 1;
}

/// Counting sort.
void CellGrid::sort_into_cells() {
  const std::size_t n = spheres_.size();
  std::vector<int> cell(n);
  begin_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]) + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    cell[i] = index(along(0, spheres_.x[i]), along(1, spheres_.y[i]), along(2, spheres_.z[i]));
    ++begin_[static_cast<std::size_t>(cell[i]) + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  order_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    order_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] = static_cast<int>(i);
}

int CellGrid::along(int axis, double coordinate) const {
  const auto a = static_cast<std::size_t>(axis);
  return std::clamp(static_cast<int>((coordinate - low_[a]) / edge_), 0, cells_[a] - 1);
}

template <class Visit>
void CellGrid::each_near(std::size_t i, Visit visit) const {
  const double x = spheres_.x[i], y = spheres_.y[i], z = spheres_.z[i], reach_i = spheres_.radius[i] + skin_;
  const int cx = along(0, x), cy = along(1, y), cz = along(2, z);
  for (int nz = std::max(cz - 1, 0); nz <= std::min(cz + 1, cells_[2] - 1); ++nz)
    for (int ny = std::max(cy - 1, 0); ny <= std::min(cy + 1, cells_[1] - 1); ++ny) {
      const auto first = static_cast<std::size_t>(index(std::max(cx - 1, 0), ny, nz));
      const auto last = static_cast<std::size_t>(index(std::min(cx + 1, cells_[0] - 1), ny, nz));
      for (int k = begin_[first]; k < begin_[last + 1]; ++k) {
        const auto j = static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
        const double dx = x - spheres_.x[j], dy = y - spheres_.y[j], dz = z - spheres_.z[j];
        const double reach = reach_i + spheres_.radius[j];
        if (dx * dx + dy * dy + dz * dz < reach * reach) visit(j);
      }
    }
}

void CellGrid::append_pairs_of(std::size_t i, std::vector<BodyPair>& pairs) const {
  const auto first_pair = static_cast<std::ptrdiff_t>(pairs.size());
  each_near(i, [&](std::size_t j) {
    if (j < i) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
  });
  std::sort(pairs.begin() + first_pair, pairs.end());
}

void CellGrid::append_pairs_of(std::size_t i, std::span<const std::uint8_t> flags,
                               std::vector<BodyPair>& pairs, std::vector<BodyPair>& above) const {
  const auto first_pair = static_cast<std::ptrdiff_t>(pairs.size());
  each_near(i, [&](std::size_t j) {
    if (j < i)
      pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    else if (flags[j] == 0)  // that of i is 1
      above.push_back({static_cast<int>(j), static_cast<int>(i)});
  });
  std::sort(pairs.begin() + first_pair, pairs.end());
}

}  // namespace repose
