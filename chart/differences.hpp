#pragma once

#include <cstddef>
#include <vector>

namespace repose::chart {

struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;
};

/// Differences between two tests of the same seed: one row a set of frictions, one entry a replicate. All
/// rows are of one length n ≥ 2.
using Differences = std::vector<std::vector<double>>;

/// What the differences say of the error of a simplification.
struct Judgement {
  std::vector<Estimate> by_set;  ///< mean of each set of frictions
  Estimate mean;                 ///< over all sets
  Estimate worst;                ///< the set whose mean is farthest from 0
  std::size_t worst_at = 0;
  double degrees_of_freedom = 0.0;
  /// Significance of the differences between the sets (F test); 1 with one set.
  double dependence_p = 1.0;
  bool depends_on_friction = false;
  /// The error, ≥ 0: of the mean, or of the worst set where the difference depends on the frictions.
  Estimate error;
  /// The error is below this with 95 % confidence: error + t(0.95, ν) × standard error, the test of
  /// equivalence of Schuirmann (1987).
  double bound_95 = 0.0;
};

/// Standard errors come from the scatter within the sets, s² with ν = sets × (n − 1) degrees of freedom. Sets
/// are taken together unless an F test finds that they differ, at the 25 % level that Bancroft (1964) advises
/// for pooling: 5 % would overlook what few replicates cannot show.
Judgement judge(const Differences& differences);

}  // namespace repose::chart
