#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <vector>

#include "chart/estimates.hpp"

namespace repose::chart {

/// The column that each entry of the rows took (/test/shared_columns), in the same order.
using Columns = std::vector<std::vector<std::uint64_t>>;

/// What shared columns add to the covariance of the means of K sets, which is s²/n on its diagonal without
/// them.
struct SharedPart {
  Eigen::MatrixXd covariance;  ///< K × K, in the square of the entries' unit; empty: nothing
  double freedom = INFINITY;   ///< degrees of freedom: columns − 1
};

/// Of two: both, with the freedom of the fewer columns.
SharedPart operator+(const SharedPart& one, const SharedPart& other);
/// The one that adds more to the sets' variances.
const SharedPart& larger(const SharedPart& one, const SharedPart& other);

/// Runs that were made from one column are alike, within a set and from set to set. An entry i is taken as
/// its set's mean plus
///     s (b_c(i) + ε_i),   Var b = σ_c²,   Var ε = σ_o²,
/// where s is the scatter of its set, c(i) its column, and σ_c² the same for all sets. With u_ic = 1 where i
/// took c and 0 elsewhere, z the residuals over s, N entries in K sets, W the u less their sets' means, A =
/// tr W Wᵀ and B = tr (W Wᵀ)² the expected squares are
///     E zᵀz = σ_o² (N − K) + σ_c² A   and   E |Wᵀz|² = σ_o² A + σ_c² B,
/// two equations for σ_o² and σ_c² (Henderson's 1953 method of moments). Columns that occur once, or a single
/// column for all, leave σ_c² open: it is 0 then.
/// Requires columns of the shape of the rows, and rows of two entries or more.
SharedPart shared_part(const Rows& rows, const Columns& columns);

}  // namespace repose::chart
