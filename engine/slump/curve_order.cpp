#include "engine/slump/curve_order.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace repose {

namespace {

constexpr int kBits = 20;

/// Bit b of each number becomes bit 3b, 3b + 1 and 3b + 2.
std::uint64_t interleaved(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  std::uint64_t code = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (const std::uint64_t number : {z, y, x}) code = code << 1 | (number >> bit & 1);
  return code;
}

}  // namespace

std::vector<std::size_t> curve_order(std::span<const Vec3> points, double cell) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;
  Vec3 low = points.front();
  for (const Vec3& point : points) low = low.cwiseMin(point);
  std::vector<std::uint64_t> code;
  for (const Vec3& point : points) {
    const Vec3 at = ((point - low) / cell).cwiseMin(static_cast<double>((1 << kBits) - 1));
    code.push_back(interleaved(static_cast<std::uint64_t>(at.x()), static_cast<std::uint64_t>(at.y()),
                               static_cast<std::uint64_t>(at.z())));
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return code[k]; });
  return order;
}

}  // namespace repose
