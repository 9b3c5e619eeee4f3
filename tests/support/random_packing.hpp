#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/base/vec3.hpp"

namespace repose::testing {

struct PackedSphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// A dense random packing of spheres of varied size between a floor (z = 0) and a lid (z = height), periodic
/// in x and y. Made by pushing apart what overlaps, from random centres (the relaxation step of Jodrey & Tory
/// 1985); spheres line the floor as in a poured bed. Unit of length: the mean diameter.
class RandomPacking {
 public:
  /// @param fraction volume fraction, 0.5 … 0.58 (above, the relaxation jams)
  /// @param spread   diameters are uniform in 1 ± spread
  RandomPacking(double width, double height, double fraction, double spread, std::uint64_t seed)
      : width_(width), height_(height), largest_(1.0 + spread) {
    RandomStream random(seed, 0);
    const double mean_volume = kPi / 6.0 * (1.0 + spread * spread);
    const auto count = static_cast<std::size_t>(fraction * width * width * height / mean_volume);
    for (std::size_t k = 0; k < count; ++k) {
      const double radius = 0.5 * random.uniform(1.0 - spread, 1.0 + spread);
      const double x = random.uniform(0.0, width);
      const double y = random.uniform(0.0, width);
      spheres_.push_back({{x, y, random.uniform(radius, height - radius)}, radius});
    }
    for (int round = 0; round < kMaxRounds && relax() > kLargestOverlap; ++round) {
    }
    for (PackedSphere& sphere : spheres_) {
      for (int axis = 0; axis < 2; ++axis) {
        sphere.centre[axis] -= width_ * std::floor(sphere.centre[axis] / width_);
      }
    }
  }

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] const std::vector<PackedSphere>& spheres() const { return spheres_; }

 private:
  static constexpr int kMaxRounds = 60;
  static constexpr int kSweepsPerRound = 8;
  static constexpr double kMargin =
      0.25;  // pairs this far apart are looked at too, for they may meet in a round
  static constexpr double kLargestOverlap = 0.03;

  /// Several sweeps over the pairs that are near; returns the largest overlap met in the last one.
  double relax() {
    const std::vector<std::pair<std::size_t, std::size_t>> pairs = near_pairs();
    double largest = 0.0;
    for (int sweep = 0; sweep < kSweepsPerRound; ++sweep) {
      largest = 0.0;
      for (const auto& [a, b] : pairs) largest = std::max(largest, push_apart(spheres_[a], spheres_[b]));
    }
    return largest;
  }

  [[nodiscard]] double wrapped(double difference) const {
    return difference - width_ * std::round(difference / width_);
  }

  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> near_pairs() const {
    const int n = static_cast<int>(width_ / (largest_ + kMargin));
    const int layers = std::max(1, static_cast<int>(height_ / (largest_ + kMargin)));
    const auto index = [&](int i, int j, int k) {
      return static_cast<std::size_t>((k * n + (j + n) % n) * n + (i + n) % n);
    };
    const auto column = [&](double x) {
      return std::min(static_cast<int>((x / width_ - std::floor(x / width_)) * n), n - 1);
    };
    const auto layer = [&](double z) {
      return std::clamp(static_cast<int>(z / height_ * layers), 0, layers - 1);
    };
    std::vector<std::vector<std::size_t>> members(index(n - 1, n - 1, layers - 1) + 1);
    for (std::size_t s = 0; s < spheres_.size(); ++s) {
      const Vec3& c = spheres_[s].centre;
      members[index(column(c.x()), column(c.y()), layer(c.z()))].push_back(s);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t s = 0; s < spheres_.size(); ++s) {
      const Vec3& c = spheres_[s].centre;
      const int k = layer(c.z());
      for (int dk = std::max(-1, -k); dk <= std::min(1, layers - 1 - k); ++dk) {
        for (int dj = -1; dj <= 1; ++dj) {
          for (int di = -1; di <= 1; ++di) {
            for (const std::size_t t : members[index(column(c.x()) + di, column(c.y()) + dj, k + dk)]) {
              const double reach = spheres_[s].radius + spheres_[t].radius + kMargin;
              if (t > s && difference(spheres_[s], spheres_[t]).squaredNorm() < reach * reach) {
                pairs.emplace_back(s, t);
              }
            }
          }
        }
      }
    }
    return pairs;
  }

  [[nodiscard]] Vec3 difference(const PackedSphere& a, const PackedSphere& b) const {
    const Vec3 d = a.centre - b.centre;
    return {wrapped(d.x()), wrapped(d.y()), d.z()};
  }

  double push_apart(PackedSphere& a, PackedSphere& b) const {
    const Vec3 d = difference(a, b);
    const double reach = a.radius + b.radius;
    const double squared = d.squaredNorm();
    if (squared >= reach * reach || squared == 0.0) return 0.0;
    const double distance = std::sqrt(squared);
    const Vec3 shift = (0.5 * (reach - distance) / distance) * d;
    a.centre += shift;
    b.centre -= shift;
    a.centre.z() = std::clamp(a.centre.z(), a.radius, height_ - a.radius);
    b.centre.z() = std::clamp(b.centre.z(), b.radius, height_ - b.radius);
    return reach - distance;
  }

  double width_;
  double height_;
  double largest_;  ///< diameter
  std::vector<PackedSphere> spheres_;
};

}  // namespace repose::testing
