#include "engine/dynamics/cell_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace repose {

namespace {

struct Grid {
  std::array<double, 3> low{};
  std::array<int, 3> cells{1, 1, 1};
  double edge = 1.0;

  [[nodiscard]] int along(int axis, double coordinate) const {
    const auto a = static_cast<std::size_t>(axis);
    return std::clamp(static_cast<int>((coordinate - low[a]) / edge), 0, cells[a] - 1);
  }
  [[nodiscard]] int index(int cx, int cy, int cz) const { return (cz * cells[1] + cy) * cells[0] + cx; }
};

Grid make_grid(const SearchSpheres& spheres, double edge) {
  Grid grid;
  std::array<double, 3> size{};
  const std::array coordinates{spheres.x, spheres.y, spheres.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(coordinates[axis].begin(), coordinates[axis].end());
    grid.low[axis] = *low;
    size[axis] = *high - *low;
  }
  const double most_cells = 4.0 * static_cast<double>(spheres.size()) + 64.0;
  for (grid.edge = edge;; grid.edge *= 1.5) {
    double cells = 1.0;
    for (const double length : size) cells *= std::floor(length / grid.edge) + 1.0;
    if (cells <= most_cells) break;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.cells[axis] = static_cast<int>(size[axis] / grid.edge) + 1;
  return grid;
}

}  // namespace

std::vector<BodyPair> near_pairs(const SearchSpheres& spheres, double skin) {
  const std::size_t n = spheres.size();
  std::vector<BodyPair> pairs;
  if (n < 2) return pairs;
  const double largest = *std::max_element(spheres.radius.begin(), spheres.radius.end());
  const Grid grid = make_grid(spheres, 2.0 * largest + skin);

  // Bodies sorted by cell (counting sort): members of cell c are order[begin[c]] … order[begin[c+1]−1],
  // ascending.
  std::vector<int> cell(n),
      begin(static_cast<std::size_t>(grid.cells[0] * grid.cells[1] * grid.cells[2]) + 1, 0), order(n);
  for (std::size_t i = 0; i < n; ++i) {
    cell[i] =
        grid.index(grid.along(0, spheres.x[i]), grid.along(1, spheres.y[i]), grid.along(2, spheres.z[i]));
    ++begin[static_cast<std::size_t>(cell[i]) + 1];
  }
  for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    order[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] = static_cast<int>(i);

  std::vector<int> partners;
  for (std::size_t i = 0; i < n; ++i) {
    partners.clear();
    const int cx = grid.along(0, spheres.x[i]), cy = grid.along(1, spheres.y[i]),
              cz = grid.along(2, spheres.z[i]);
    for (int nz = std::max(cz - 1, 0); nz <= std::min(cz + 1, grid.cells[2] - 1); ++nz)
      for (int ny = std::max(cy - 1, 0); ny <= std::min(cy + 1, grid.cells[1] - 1); ++ny) {
        const auto first = static_cast<std::size_t>(grid.index(std::max(cx - 1, 0), ny, nz));
        const auto last = static_cast<std::size_t>(grid.index(std::min(cx + 1, grid.cells[0] - 1), ny, nz));
        for (int k = begin[first]; k < begin[last + 1]; ++k) {
          const int other = order[static_cast<std::size_t>(k)];
          const auto j = static_cast<std::size_t>(other);
          if (j <= i) continue;
          const double dx = spheres.x[i] - spheres.x[j], dy = spheres.y[i] - spheres.y[j],
                       dz = spheres.z[i] - spheres.z[j];
          const double reach = spheres.radius[i] + spheres.radius[j] + skin;
          if (dx * dx + dy * dy + dz * dz < reach * reach) partners.push_back(other);
        }
      }
    std::sort(partners.begin(), partners.end());
    for (const int j : partners) pairs.push_back({static_cast<int>(i), j});
  }
  return pairs;
}

}  // namespace repose
