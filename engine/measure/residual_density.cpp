#include "engine/measure/residual_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace repose {

namespace {

constexpr std::size_t kCellsPerBandwidth = 4;
constexpr std::size_t kReach = 4 * kCellsPerBandwidth;  // the kernel is cut at four standard deviations
constexpr double kFloor = 0.02;

/// Distance of the kernel's cell k from its middle, in bandwidths.
double kernel_place(std::size_t k) {
  return (static_cast<double>(k) - static_cast<double>(kReach)) / static_cast<double>(kCellsPerBandwidth);
}

std::array<double, 2 * kReach + 1> gaussian_kernel() {
  std::array<double, 2 * kReach + 1> kernel{};
  for (std::size_t k = 0; k < kernel.size(); ++k)
    kernel[k] = std::exp(-0.5 * kernel_place(k) * kernel_place(k));
  return kernel;
}

/// Weights shared between the two nearest cells.
std::vector<double> histogram(const std::vector<double>& values, const std::vector<double>& weights,
                              double low, double step, std::size_t cells) {
  std::vector<double> counts(cells, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double u = (values[i] - low) / step;
    const double cell = std::floor(u);
    counts[static_cast<std::size_t>(cell)] += weights[i] * (1.0 - (u - cell));
    counts[static_cast<std::size_t>(cell) + 1] += weights[i] * (u - cell);
  }
  return counts;
}

}  // namespace

ResidualDensity::ResidualDensity(const std::vector<double>& residuals, const std::vector<double>& weights,
                                 double bandwidth) {
  // Tops that lie in one line but for a few far from it have no width of their own: the cells of the whole
  // range must still fit into memory.
  constexpr double kMostCells = 1e5, kNarrowest = 1e-12;  // [-], [m]
  const auto [least, most] = std::minmax_element(residuals.begin(), residuals.end());
  bandwidth = std::max(
      {bandwidth, static_cast<double>(kCellsPerBandwidth) * (*most - *least) / kMostCells, kNarrowest});
  step_ = bandwidth / static_cast<double>(kCellsPerBandwidth);
  low_ = *least - static_cast<double>(kReach + 1) * step_;
  const auto cells = static_cast<std::size_t>((*most - low_) / step_) + kReach + 3;
  const std::vector<double> counts = histogram(residuals, weights, low_, step_, cells);

  static const auto kernel = gaussian_kernel();
  std::vector<double> density(cells, 0.0);
  std::vector<double> slope(cells, 0.0);
  for (std::size_t c = kReach; c + kReach < cells; ++c) {
    if (counts[c] == 0.0) continue;
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const double value = counts[c] * kernel[k];
      density[c - kReach + k] += value;
      slope[c - kReach + k] -= value * kernel_place(k) / bandwidth;
    }
  }
  const double floor = kFloor * *std::max_element(density.begin(), density.end());
  score_.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) score_[c] = -slope[c] / (density[c] + floor);
}

double ResidualDensity::score(double residual) const {
  const double u = std::clamp((residual - low_) / step_, 0.0, static_cast<double>(score_.size() - 2));
  const double cell = std::floor(u);
  const auto c = static_cast<std::size_t>(cell);
  return score_[c] + (u - cell) * (score_[c + 1] - score_[c]);
}

}  // namespace repose
