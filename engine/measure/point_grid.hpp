#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/base/vec3.hpp"

namespace repose {

/// Points sorted into hashed cubic cells, so that single points far away cost no memory.
class PointGrid {
 public:
  /// @param cell edge of a cell, > 0 [m]
  PointGrid(std::vector<Vec3> points, double cell) : points_(std::move(points)), cell_(cell) {
    std::size_t buckets = 16;
    while (buckets < 2 * points_.size()) buckets *= 2;
    mask_ = buckets - 1;
    std::vector<std::size_t> bucket(points_.size());
    start_.assign(buckets + 1, 0);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      bucket[p] = bucket_of(cell_of(points_[p].x()), cell_of(points_[p].y()), cell_of(points_[p].z()));
      ++start_[bucket[p] + 1];
    }
    for (std::size_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
    sorted_.resize(points_.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t p = 0; p < points_.size(); ++p) sorted_[next[bucket[p]]++] = p;
  }

  /// Calls visit(index, squared distance) for every point within radius of centre, in a fixed order; a point
  /// may come more than once.
  template <class Visit>
  void each_within(const Vec3& centre, double radius, const Visit& visit) const {
    const auto low = [&](int axis) { return cell_of(centre[axis] - radius); };
    const auto high = [&](int axis) { return cell_of(centre[axis] + radius); };
    for (std::int64_t k = low(2); k <= high(2); ++k) {
      for (std::int64_t j = low(1); j <= high(1); ++j) {
        for (std::int64_t i = low(0); i <= high(0); ++i) {
          const std::size_t bucket = bucket_of(i, j, k);
          for (std::size_t s = start_[bucket]; s < start_[bucket + 1]; ++s) {
            const double squared = (points_[sorted_[s]] - centre).squaredNorm();
            if (squared <= radius * radius) visit(sorted_[s], squared);
          }
        }
      }
    }
  }

 private:
  [[nodiscard]] std::int64_t cell_of(double x) const {
    return static_cast<std::int64_t>(std::floor(x / cell_));
  }
  [[nodiscard]] std::size_t bucket_of(std::int64_t i, std::int64_t j, std::int64_t k) const {
    const auto word = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
    return static_cast<std::size_t>(mix64(word(i) * 0x9e3779b97f4a7c15ULL ^ word(j) * 0xc2b2ae3d27d4eb4fULL ^
                                          word(k) * 0x165667b19e3779f9ULL)) &
           mask_;
  }

  std::vector<Vec3> points_;
  double cell_;
  std::size_t mask_ = 0;
  std::vector<std::size_t> start_;   ///< first entry of sorted_ per bucket
  std::vector<std::size_t> sorted_;  ///< indices of points by bucket
};

}  // namespace repose
