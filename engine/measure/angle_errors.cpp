#include <cmath>

#include "engine/base/vec3.hpp"
#include "engine/measure/flank_reader.hpp"

namespace repose {

namespace {

constexpr int kWedges = 24;
constexpr int kIterations = 15;

int wedge_of(const FlankPoint& p) {
  // From −45°, so that each flank holds six whole wedges.
  double turned = p.phi + 0.25 * kPi;
  if (turned < 0.0) turned += 2.0 * kPi;
  return std::min(static_cast<int>(turned / (2.0 * kPi) * kWedges), kWedges - 1);
}

/// (n − 1)/n Σ (x − x̄)²
double jackknife_variance(const std::vector<double>& x) {
  const auto n = static_cast<double>(x.size());
  double mean = 0.0;
  double sum = 0.0;
  for (const double value : x) mean += value / n;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return sum * (n - 1.0) / n;
}

}  // namespace

AngleErrors angle_errors(const FlankReading& reading) {
  std::array<std::vector<double>, 4> flank;
  std::vector<double> mean;
  for (int wedge = 0; wedge < kWedges; ++wedge) {
    std::vector<double> weights(reading.points.size(), 1.0);
    bool empty = true;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (wedge_of(reading.points[i]) != wedge) continue;
      weights[i] = 0.0;
      empty = false;
    }
    if (empty) continue;
    const FlankLines lines =
        fit_adaptive(reading.points, weights, reading.lines, reading.bandwidth, kIterations);
    mean.push_back(0.0);
    for (std::size_t f = 0; f < 4; ++f) {
      flank[f].push_back(std::atan(lines.slope[f]));
      mean.back() += 0.25 * flank[f].back();
    }
  }
  AngleErrors errors;
  errors.mean = std::sqrt(jackknife_variance(mean));
  for (std::size_t f = 0; f < 4; ++f) errors.flank[f] = std::sqrt(jackknife_variance(flank[f]));
  return errors;
}

}  // namespace repose
