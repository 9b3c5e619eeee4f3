#include "engine/measure/flank_reader.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/vec3.hpp"

namespace repose {

namespace {

constexpr int kRobustRounds = 12;
constexpr int kRobustIterations = 4;
constexpr int kAdaptiveRounds = 3;
constexpr int kAdaptiveIterations = 60;
constexpr double kBand = 2.0;  // half the width of the band around the lines that tops are taken from, in d
constexpr double kLowestTop = 1.25;  // of a flank, in d: the single layer around the foot is no flank
constexpr double kBandwidth = 0.27;  // of the distances' spread, for kBandwidthTops tops
constexpr double kBandwidthTops = 500.0;

FlankWindow window_of(const HeapOutline& outline, const MeasureOptions& options) {
  const double lowest = kLowestTop * outline.diameter;
  if (outline.height < kFlatHeight * outline.diameter) {
    const double reach = std::min(outline.radius, outline.edge_radius);
    return {lowest, true, (1.0 - options.window_high) * reach, (1.0 - options.window_low) * reach};
  }
  return {lowest, false, options.window_low * outline.height, options.window_high * outline.height};
}

bool inside(const FlankWindow& window, const FlankPoint& p, const FlankLines& lines) {
  const double height = lines.height(p);
  const double position = window.in_radius ? std::hypot(p.u, p.v) : height;
  return height >= window.lowest && window.low <= position && position <= window.high;
}

/// The tops in the window and within band of the lines.
std::vector<FlankPoint> points_in_window(const std::vector<SurfaceTop>& surface, const HeapOutline& outline,
                                         const FlankReading& reading, double band) {
  std::vector<FlankPoint> points;
  for (const SurfaceTop& top : surface) {
    if (std::hypot(top.x, top.y) > outline.edge_radius) continue;
    const FlankPoint p = flank_point(top, reading.x0, reading.y0);
    if (inside(reading.window, p, reading.lines) && std::abs(p.z - reading.lines.height(p)) <= band) {
      points.push_back(p);
    }
  }
  return points;
}

/// Moves the axis to where opposite flanks are equally far at the mean height of the points, by no more than
/// limit.
void centre_axis(FlankReading& reading, double limit) {
  FlankLines& lines = reading.lines;
  double level = 0.0;
  for (const FlankPoint& p : reading.points)
    level += lines.height(p) / static_cast<double>(reading.points.size());
  const auto shift = [&](std::size_t plus, std::size_t minus) {
    const double out = (lines.z0[plus] - level) / lines.slope[plus];
    const double back = (lines.z0[minus] - level) / lines.slope[minus];
    const double by = std::clamp(0.5 * (out - back), -limit, limit);
    lines.z0[plus] -= lines.slope[plus] * by;
    lines.z0[minus] += lines.slope[minus] * by;
    return by;
  };
  reading.x0 += shift(0, 1);
  reading.y0 += shift(2, 3);
}

/// Standard deviation of a normal distribution with the distances' interquartile range.
double spread(const std::vector<FlankPoint>& points, const FlankLines& lines) {
  std::vector<double> e;
  e.reserve(points.size());
  for (const FlankPoint& p : points) e.push_back(p.z - lines.height(p));
  std::sort(e.begin(), e.end());
  return (e[e.size() * 3 / 4] - e[e.size() / 4]) / 1.349;
}

double bandwidth_of(const FlankReading& reading, double diameter) {
  const auto tops = static_cast<double>(reading.points.size());
  const double scale = std::max(spread(reading.points, reading.lines), 1e-3 * diameter);
  return kBandwidth * scale * std::sqrt(kBandwidthTops / tops);
}

bool enough(const std::vector<FlankPoint>& points) {
  std::array<int, 4> count{};
  for (const FlankPoint& p : points) ++count[static_cast<std::size_t>(p.flank)];
  return *std::min_element(count.begin(), count.end()) >= kLeastTops;
}

}  // namespace

FlankReading read_flanks(const std::vector<SurfaceTop>& surface, const HeapOutline& outline,
                         const MeasureOptions& options) {
  FlankReading reading;
  reading.x0 = outline.x0;
  reading.y0 = outline.y0;
  reading.lines.z0.fill(outline.height);
  reading.lines.slope.fill(outline.height / outline.radius);
  reading.window = window_of(outline, options);

  // The first lines may be far off: the band that tops are taken from narrows round by round.
  double band = std::max(0.5 * outline.height, kBand * outline.diameter);
  for (int round = 0; round < kRobustRounds; ++round) {
    reading.points = points_in_window(surface, outline, reading, band);
    if (!enough(reading.points)) return reading;
    reading.lines = fit_robust(reading.points, reading.lines, band, kRobustIterations);
    if (round > 0) centre_axis(reading, outline.diameter);
    band = std::max(0.7 * band, kBand * outline.diameter);
  }
  for (int round = 0; round < kAdaptiveRounds; ++round) {
    reading.points = points_in_window(surface, outline, reading, kBand * outline.diameter);
    if (!enough(reading.points)) return reading;
    reading.bandwidth = bandwidth_of(reading, outline.diameter);
    const std::vector<double> weights(reading.points.size(), 1.0);
    reading.lines =
        fit_adaptive(reading.points, weights, reading.lines, reading.bandwidth, kAdaptiveIterations);
    if (round + 1 < kAdaptiveRounds) centre_axis(reading, outline.diameter);
  }
  reading.readable = true;
  return reading;
}

}  // namespace repose
