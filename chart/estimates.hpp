#pragma once

#include <vector>

namespace repose::chart {

/// One row a set of frictions, one entry a replicate.
using Rows = std::vector<std::vector<double>>;

struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;
};

/// The mean of each row and its standard error, s/√n with the s of that row. Requires two entries a row.
std::vector<Estimate> estimates_of(const Rows& rows);

}  // namespace repose::chart
