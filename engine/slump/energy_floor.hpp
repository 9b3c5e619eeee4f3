#pragma once

#include <array>
#include <optional>

namespace repose {

/// Kinetic energy of the bodies at one instant.
struct EnergyLevel {
  double ratio = 0.0;     ///< mean per body over m g d [-]
  double rotation = 0.0;  ///< share of it that is rotation, 0 … 1
};

/// A stage that waits for rest, watched in quarters of its time: does the energy still fall, or has it
/// reached a floor? Between two quarters of a heap that comes to rest the energy falls by orders of
/// magnitude.
class EnergyFloor {
 public:
  static constexpr double kStillFalls =
      0.5;  ///< of the third quarter's mean is what the last one must stay below

  /// @param share  of the stage's time, 0 … 1
  void add(double share, const EnergyLevel& level) {
    Quarter& quarter = quarters_[share < 1.0 ? static_cast<std::size_t>(4.0 * share) : 3];
    quarter.ratio += level.ratio;
    quarter.rotating += level.ratio * level.rotation;
    quarter.count += 1.0;
  }
  /// The mean of the last quarter where it is a floor.
  [[nodiscard]] std::optional<EnergyLevel> level() const {
    const Quarter &before = quarters_[2], &last = quarters_[3];
    if (before.count == 0.0 || last.count == 0.0 || last.ratio <= 0.0) return std::nullopt;
    if (last.ratio / last.count < kStillFalls * before.ratio / before.count) return std::nullopt;
    return EnergyLevel{last.ratio / last.count, last.rotating / last.ratio};
  }

 private:
  struct Quarter {
    double ratio = 0.0, rotating = 0.0, count = 0.0;
  };
  std::array<Quarter, 4> quarters_{};
};

}  // namespace repose
