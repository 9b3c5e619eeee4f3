#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sweep/study.hpp"
#include "tools/report/study_report.hpp"

namespace repose::program {

/// Keeps the heaps of those runs of a sweep that its report will show, as far as can be told while it runs:
/// the lowest and the highest angle so far, and the nearest to the measured one. At most three heaps are in
/// memory.
class HeapKeeper {
 public:
  /// @param measured  angle [deg]
  explicit HeapKeeper(double measured) : measured_(measured) {}
  void see(const sweep::StoredRun& run, const RunResult& result);
  /// The heap of a run, or nullptr.
  [[nodiscard]] const HeapSnapshot* heap_of(const std::string& run_key) const;

 private:
  struct Kept {
    std::string run_key;
    double rank = 0.0;  ///< the smaller, the nearer to what is looked for
    HeapSnapshot heap;
  };
  double measured_;
  std::array<std::optional<Kept>, 3> kept_;
};

/// A run whose heap is shown.
struct ShownRun {
  sweep::StoredRun run;
  std::string why;  ///< "lowest angle", …
};

/// The runs of the design with the lowest and the highest angle, and the one nearest to the measured angle
/// [deg] where there is one; a run that is two of them stands once. In the order of their angles.
std::vector<ShownRun> runs_to_show(const std::vector<sweep::StoredRun>& runs, std::optional<double> measured);

/// Pictures of their heaps and side profiles in the study's folder heaps/, named by the run's key, so that a
/// picture that is there needs not be made again. A heap that is not kept is simulated again, which gives the
/// same bits; where it would not (another version of the program), it has no picture.
/// @param keeper  may be nullptr
/// Throws std::runtime_error where gnuplot fails.
std::vector<report::Picture> draw_heaps(const sweep::Study& study, const std::vector<ShownRun>& shown,
                                        const HeapKeeper* keeper, bool quiet);

}  // namespace repose::program
