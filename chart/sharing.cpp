#include "chart/sharing.hpp"

#include <algorithm>
#include <map>

namespace repose::chart {

namespace {

/// Of the (N − K) B that A² is less than where entries tell columns and their own noise apart.
constexpr double kLeast = 1e-9;

/// u of all entries, sets one below the other.
Eigen::MatrixXd indicators_of(const Columns& columns) {
  std::map<std::uint64_t, Eigen::Index> numbers;
  std::vector<Eigen::Index> of_entries;
  for (const auto& set : columns)
    for (const std::uint64_t column : set)
      of_entries.push_back(numbers.emplace(column, static_cast<Eigen::Index>(numbers.size())).first->second);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(of_entries.size()),
                                            static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < of_entries.size(); ++i) u(static_cast<Eigen::Index>(i), of_entries[i]) = 1.0;
  return u;
}

/// @param w  W: N × columns
/// @param z  residuals over the scatter of their sets
double variance_of_columns(const Eigen::MatrixXd& w, const Eigen::VectorXd& z, double freedom) {
  const double a = w.squaredNorm(), b = (w.transpose() * w).squaredNorm();
  const double open = freedom * b - a * a;
  if (!(open > kLeast * freedom * b)) return 0.0;
  const double squares = (w.transpose() * z).squaredNorm();
  const double variance = (freedom * squares - a * z.squaredNorm()) / open;
  return std::clamp(variance, 0.0, freedom / a);  // σ_o² ≥ 0
}

}  // namespace

SharedPart operator+(const SharedPart& one, const SharedPart& other) {
  if (one.covariance.size() == 0) return other;
  if (other.covariance.size() == 0) return one;
  return {one.covariance + other.covariance, std::min(one.freedom, other.freedom)};
}

const SharedPart& larger(const SharedPart& one, const SharedPart& other) {
  if (other.covariance.size() == 0) return one;
  return one.covariance.size() > 0 && one.covariance.trace() >= other.covariance.trace() ? one : other;
}

SharedPart shared_part(const Rows& rows, const Columns& columns) {
  const std::vector<Estimate> estimates = estimates_of(rows);
  const auto sets = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd w = indicators_of(columns), of_sets(sets, w.cols());
  Eigen::VectorXd z(w.rows()), s(sets), n(sets);
  Eigen::Index first = 0;
  for (Eigen::Index set = 0; set < sets; ++set) {
    const auto& [mean, error] = estimates[static_cast<std::size_t>(set)];
    const std::vector<double>& row = rows[static_cast<std::size_t>(set)];
    const auto size = static_cast<Eigen::Index>(row.size());
    n[set] = static_cast<double>(size);
    s[set] = error * std::sqrt(n[set]);
    of_sets.row(set) = w.middleRows(first, size).colwise().mean();
    w.middleRows(first, size).rowwise() -= of_sets.row(set);
    z.segment(first, size).setZero();
    if (s[set] > 0.0)
      z.segment(first, size) = (Eigen::Map<const Eigen::ArrayXd>(row.data(), size) - mean) / s[set];
    first += size;
  }
  const auto freedom = static_cast<double>(w.rows() - sets);
  const double variance = variance_of_columns(w, z, freedom);
  Eigen::MatrixXd covariance = variance * of_sets * of_sets.transpose();
  // s² is that of both, so that s²/n holds some of what columns add.
  covariance.diagonal() -= (variance * w.squaredNorm() / freedom * n.array().inverse()).matrix();
  return {s.asDiagonal() * covariance * s.asDiagonal(), static_cast<double>(w.cols()) - 1.0};
}

}  // namespace repose::chart
