#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chart/differences.hpp"

namespace repose::chart {

/// One run, as far as a chart looks at it.
struct Sample {
  std::string outcome;  ///< name_of(Outcome)
  std::string reason;
  double angle = 0.0;                   ///< [degrees]
  double density = 0.0;                 ///< of the column [kg/m³]
  double mass = 0.0;                    ///< on the base [kg]
  double cpu = 0.0;                     ///< [s]
  std::string engine;                   ///< that made it, with its instruction set
  std::optional<std::uint64_t> column;  ///< that it shares with others (number_of_column())

  [[nodiscard]] bool completed() const { return outcome == "completed"; }
};

/// Runs of one test: one row a set of frictions, one entry a replicate.
using Samples = std::vector<std::vector<Sample>>;

/// The first run that did not complete, if any.
const Sample* first_failure(const Samples& samples);
/// How many runs ended how.
std::map<std::string, int> outcomes_of(const Samples& samples);
/// Mean CPU time of a run [s].
double mean_cpu(const Samples& samples);
/// Their angles [degrees].
Rows angles_of(const Samples& samples);
/// Standard deviation of the angle from run to run, root mean square over the sets [degrees]. All runs are
/// completed.
double scatter_of_angle(const Samples& samples);
/// Angle of the one minus that of the other, run by run [degrees]. All runs are completed. Where the test has
/// m times as many runs as the reference's n, the mean of its runs k, k + n, k + 2 n, … is compared with the
/// reference's run k: the scatter of the differences then is that of one run of the reference and m of the
/// test. Where runs of a test share columns the differences know it.
Differences angle_differences(const Samples& test, const Samples& reference);

/// A rung against the reference. Of a rung with a run that did not complete only name, outcomes, reason and
/// cost are filled.
struct Comparison {
  std::string name;
  std::map<std::string, int> outcomes;
  std::string reason;  ///< of the first run that did not complete; empty where all did
  bool completed = false;
  double cpu = 0.0;       ///< mean of a run [s]
  double speed_up = 0.0;  ///< cost of the reference over this
  Judgement angle;        ///< [degrees]
  /// Angle less that of the working point, mean of all pairs [degrees]; the working point's own is 0. Empty
  /// where there is none or it did not complete.
  std::optional<Estimate> off_working_point;
  Judgement density;  ///< relative difference of the column's density [%]
  /// Relative difference of the mass on the base [%]. It scatters less than the angle: by 1 to 2 % from run
  /// to run of 3 kg, where one degree of 30 is 3 %. So it shows what depends on the frictions before the
  /// angle does.
  Judgement mass;
  /// All runs, of it or of the reference, took a single shared column: what that adds to all of them cannot
  /// be told from them.
  bool one_column = false;
  bool on_front = false;  ///< no other rung, nor the reference, is both cheaper and nearer
};

/// Requires that all runs of the reference completed and both have the same sets, and the rung a multiple
/// of the reference's replicates.
Comparison compare(const std::string& name, const Samples& test, const Samples& reference);

/// Marks the Pareto front of cost against error. The reference, of cost `reference_cpu` and error 0, takes
/// part.
void mark_front(std::vector<Comparison>& rungs, double reference_cpu);

}  // namespace repose::chart
