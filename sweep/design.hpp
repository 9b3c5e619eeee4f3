#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sweep/ladder.hpp"

namespace repose::sweep {

enum class DesignKind { full_factorial, latin_hypercube, sobol, table, chart };

/// One thing that the runs of a sweep differ in.
struct Factor {
  std::string name;     ///< as the case writes it: e_pp, mu_s, mu_r or a JSON pointer
  std::string pointer;  ///< of the number in the case
  /// full_factorial: every value; latin_hypercube and sobol: {low, high}; table: empty.
  std::vector<double> levels;
};

/// One row of a table design.
struct TableRow {
  std::vector<double> values;  ///< in the order of Design::factors
  int replicate = 0;           ///< 0: the table has no such column
  int line = 0;                ///< in the file, from 1
};

/// What /sweep of a case says, checked.
struct Design {
  DesignKind kind = DesignKind::full_factorial;
  std::vector<Factor> factors;
  int runs = 0;                        ///< points of latin_hypercube and sobol
  int replicates = 1;                  ///< runs a point, each with a seed of its own
  std::uint64_t seed = 1;              ///< of the whole sweep
  bool common_random_numbers = false;  ///< one seed per replicate, the same at every point
  bool scramble = false;               ///< sobol: shifted by random words of the seed
  std::string table_file;              ///< table: the CSV as the case writes it
  std::vector<TableRow> rows;          ///< table: all rows
  Ladder ladder;                       ///< chart: what stands at /chart
};

/// A point of a design with the numbers of its replicates (1, 2, …).
struct DesignPoint {
  std::vector<double> values;  ///< in the order of Design::factors
  std::vector<int> replicates;
  std::size_t rung = 0;  ///< chart: 0 is the reference, k the k-th rung
};

/// The points in their order:
/// - full_factorial: all combinations, the last factor fastest;
/// - latin_hypercube: x_i = (π(i) + u_i) / n per factor with its own random permutation π and u uniform in
///   [0, 1) (McKay, Beckman & Conover 1979), so that each of n equal strata of a factor holds one point;
/// - sobol: the first n points of the sequence from the origin on (sobol.hpp), shifted if `scramble`;
/// - chart: the reference and each rung with every set of frictions, the frictions fastest;
/// - table: the distinct rows in the order of their first appearance.
/// Values are low + (high − low) x. The same design gives the same bits on every machine. Points do not
/// depend on how many there are (full_factorial, sobol, table), so that a design can be extended.
std::vector<DesignPoint> points_of(const Design& design);

/// Seed of a run: a function of the sweep's seed, the replicate and, unless the random numbers are common,
/// the values of the point (not its number: points that are added later do not change the seeds of others).
/// Below 2^53, so that every reader of JSON and CSV keeps all its digits.
///
/// Independent seeds are the default, because the fit's standard errors take the errors of the points as
/// independent. With common random numbers all points share the same particles and the same order of pouring:
/// differences between points are then less noisy, but all points share that sample's own deviation. The
/// rungs of a chart share the seeds of their frictions' set: the differences between them are what is looked
/// for.
std::uint64_t seed_of(const Design& design, const std::vector<double>& values, int replicate);

/// 64-bit hash of a point's values with the pointers that they belong to, whatever their order.
std::uint64_t hash_of_point(const Design& design, const std::vector<double>& values);

}  // namespace repose::sweep
