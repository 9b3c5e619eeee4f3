#pragma once

#include <cstddef>
#include <vector>

#include "chart/sharing.hpp"

namespace repose::chart {

/// Differences between two tests of the same seed: one row a set of frictions, one entry a replicate. Every
/// row has two entries at least.
struct Differences {
  Rows rows;
  SharedPart shared;  ///< what runs that share columns add to the covariance of the means of the sets
};

/// What the differences say of the error of a simplification. δ is the true difference of a set of frictions,
/// d its mean over the replicates.
struct Judgement {
  /// d of each set, its error from the set's own scatter and what shared columns add.
  std::vector<Estimate> by_set;
  Estimate mean;               ///< over all sets
  double mean_bound_95 = 0.0;  ///< |mean of δ| is below this with 95 % confidence (Schuirmann 1987)
  Estimate worst;              ///< the set whose d is farthest from 0
  std::size_t worst_at = 0;
  /// Significance of the differences between the sets (F test of Welch 1951); 1 with one set.
  double dependence_p = 1.0;
  bool depends_on_friction = false;  ///< at the 5 % level
  /// √(mean of d²): how far the angle of a set of frictions is off, be it the same way with all or with each
  /// another way. As measured, the noise of the replicates included.
  double error = 0.0;
  double low_95 = 0.0;    ///< the true error, √(mean of δ²), is above this with 95 % confidence
  double bound_95 = 0.0;  ///< the true error is below this with 95 % confidence
  /// What the bound would be if the differences were of the size of their noise. It falls as 1/√n.
  double noise_bound_95 = 0.0;
};

Judgement judge(const Differences& differences);

}  // namespace repose::chart
