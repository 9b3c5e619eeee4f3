#pragma once

#include <algorithm>
#include <deque>
#include <optional>

#include "engine/measure/heap_measurement.hpp"

namespace repose {

/// Whether a heap's angle stands still: it is read every kInterval, and the last kReadings, 0.1 s of them,
/// lie within a bound of each other.
class StillAngle {
 public:
  static constexpr double kInterval = 0.02;  ///< simulated [s]
  static constexpr std::size_t kReadings = 6;

  /// @param change  the bound [rad]
  explicit StillAngle(double change) : change_(change) {}

  [[nodiscard]] bool due(double time) const { return time >= next_; }

  /// Takes a reading. Returns since when the angle has stood still, or nothing while it moves or cannot be
  /// read.
  std::optional<double> look(double time, const HeapMeasurement& heap) {
    next_ = time + kInterval;
    if (!heap.has_heap) {
      readings_.clear();
      return std::nullopt;
    }
    readings_.push_back({time, heap.angle});
    if (readings_.size() > kReadings) readings_.pop_front();
    const auto [low, high] = std::ranges::minmax_element(readings_, {}, &Reading::angle);
    const bool still = readings_.size() == kReadings && high->angle - low->angle < change_;
    return still ? std::optional(readings_.front().time) : std::nullopt;
  }

 private:
  struct Reading {
    double time = 0.0;
    double angle = 0.0;
  };
  double change_;
  double next_ = 0.0;
  std::deque<Reading> readings_;  ///< the last, without a gap
};

}  // namespace repose
