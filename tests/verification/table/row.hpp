#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace repose::verification {

/// One line of the verification table. Where a test has many points, theory and result are those of the worst
/// one.
struct Row {
  std::string test;
  std::string source;
  double theory = 0.0;
  double result = 0.0;
  double error = 0.0;
  double bar = 0.0;
  [[nodiscard]] bool passed() const { return error <= bar; }  ///< false for a NaN
};

/// Collects points and keeps the worst of them.
class Worst {
 public:
  Worst(std::string test, std::string source, double bar)
      : row_{std::move(test), std::move(source), 0, 0, 0, bar} {}

  /// A point with the error |result − theory| / scale.
  void add(double theory, double result, double scale) {
    const double error = std::abs(result - theory) / std::abs(scale);
    if (points_++ > 0 && (std::isnan(row_.error) || error <= row_.error)) return;
    row_.theory = theory, row_.result = result, row_.error = error;
  }
  void add(double theory, double result) { add(theory, result, theory); }
  /// A NaN error where there was no point at all.
  [[nodiscard]] Row row() const {
    Row row = row_;
    if (points_ == 0) row.error = std::numeric_limits<double>::quiet_NaN();
    return row;
  }

 private:
  Row row_;
  int points_ = 0;
};

using Rows = std::vector<Row>;

Rows normal_impact_rows();
Rows oblique_impact_rows();
Rows restitution_rows();
Rows sliding_and_rolling_rows();
Rows cycle_rows();
Rows bounce_rows();
Rows integrator_rows();
Rows rotation_rows();
Rows clump_rows();
Rows heap_angle_rows();

/// Every row, in the order of the table.
inline Rows all_rows() {
  Rows all;
  for (const auto part :
       {normal_impact_rows, oblique_impact_rows, restitution_rows, cycle_rows, sliding_and_rolling_rows,
        bounce_rows, integrator_rows, rotation_rows, clump_rows, heap_angle_rows}) {
    const Rows rows = part();
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

}  // namespace repose::verification
