#include "chart/estimates.hpp"

#include <Eigen/Core>
#include <cmath>

namespace repose::chart {

std::vector<Estimate> estimates_of(const Rows& rows) {
  std::vector<Estimate> estimates;
  for (const std::vector<double>& row : rows) {
    const auto values = Eigen::Map<const Eigen::ArrayXd>(row.data(), static_cast<Eigen::Index>(row.size()));
    const double n = static_cast<double>(row.size()), mean = values.mean();
    estimates.push_back({mean, std::sqrt((values - mean).square().sum() / (n - 1.0) / n)});
  }
  return estimates;
}

}  // namespace repose::chart
