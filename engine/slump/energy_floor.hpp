#pragma once

#include <array>
#include <cmath>
#include <optional>

namespace repose {

/// Kinetic energy of the bodies at one instant.
struct EnergyLevel {
  double ratio = 0.0;     ///< mean per body over m g d [-]
  double rotation = 0.0;  ///< share of it that is rotation, 0 … 1
};

/// A stage that waits for rest, watched in quarters of its time: would the energy reach its limit if the
/// stage went on, or has it come to a floor? Between two quarters of a heap that comes to rest the energy
/// falls by orders of magnitude; on a floor it wavers.
class EnergyFloor {
 public:
  /// Further quarters, at the fall of the last one, that count as a matter of time: the stage once more.
  static constexpr double kPatience = 4.0;

  /// @param share  of the stage's time, 0 … 1
  void add(double share, const EnergyLevel& level) {
    Quarter& quarter = quarters_[share < 1.0 ? static_cast<std::size_t>(4.0 * share) : 3];
    quarter.ratio += level.ratio;
    quarter.rotating += level.ratio * level.rotation;
    quarter.count += 1.0;
  }
  /// The mean of the last quarter where it is a floor.
  /// @param limit  of the ratio, below which there is rest
  [[nodiscard]] std::optional<EnergyLevel> level(double limit) const {
    const Quarter &before = quarters_[2], &last = quarters_[3];
    if (before.count == 0.0 || last.count == 0.0 || last.ratio <= 0.0) return std::nullopt;
    const double now = last.ratio / last.count, fall = before.ratio / before.count / now;
    if (fall > 1.0 && std::log(now / limit) < kPatience * std::log(fall)) return std::nullopt;
    return EnergyLevel{now, last.rotating / last.ratio};
  }

 private:
  struct Quarter {
    double ratio = 0.0, rotating = 0.0, count = 0.0;
  };
  std::array<Quarter, 4> quarters_{};
};

}  // namespace repose
