#pragma once

#include <cmath>
#include <limits>

#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/cell_grid.hpp"

namespace repose {

/// How two bodies lie to one another.
struct RelativePose {
  Vec3 apart;    ///< x_i − x_j [m]
  double swung;  ///< Bodies::swung of both together [m]

  RelativePose(const Bodies& bodies, const BodyPair& pair) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    apart = bodies.position(i) - bodies.position(j);
    swung = bodies.swung[i] + bodies.swung[j];
  }
};

/// Bounds how far spheres of two bodies move towards each other. Since an earlier pose that is at most
///
///   |Δ apart| + Δ swung,
///
/// the way of the bodies and the paths that their spheres have swung about them. Two bodies that go the same
/// way get nowhere by it, however fast they are. Four floats, since there are many pairs: what they round off
/// counts as movement.
class Tether {
 public:
  /// Holds nothing.
  Tether() = default;
  /// @param slack  how far the two may move towards each other from here [m]
  Tether(const RelativePose& pose, double slack)
      : apart_{static_cast<float>(pose.apart.x()), static_cast<float>(pose.apart.y()),
               static_cast<float>(pose.apart.z())},
        limit_(static_cast<float>(pose.swung + slack)) {}

  /// Whether the two are within the slack, and will be after moving towards each other by another `further`.
  [[nodiscard]] bool holds(const RelativePose& now, double further) const {
    const Vec3 moved(now.apart.x() - static_cast<double>(apart_[0]),
                     now.apart.y() - static_cast<double>(apart_[1]),
                     now.apart.z() - static_cast<double>(apart_[2]));
    constexpr double kRounded = std::numeric_limits<float>::epsilon();
    const double rounded = kRounded * (std::abs(now.apart.x()) + std::abs(now.apart.y()) +
                                       std::abs(now.apart.z()) + std::abs(static_cast<double>(limit_)));
    const double left = static_cast<double>(limit_) - now.swung - further - rounded;
    return left >= 0.0 && moved.squaredNorm() <= left * left;
  }

 private:
  float apart_[3] = {};
  float limit_ = -std::numeric_limits<float>::infinity();  ///< of swung, where nothing else has moved
};

}  // namespace repose
