#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/base/warning.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/slump/motion_watch.hpp"

namespace repose {

/// A column that was filled and settled with the contact of SharedColumns, before a run turns it about its
/// axis and settles it again with its own.
struct SharedColumn {
  std::vector<NewBody> bodies;  ///< at rest
  double strain = 0.0;          ///< elastic energy of their normal contacts [J]
  MotionDiagnosis diagnosis;
  std::vector<Warning> warnings;
  Verdict verdict;  ///< `completed`, or why there is no column
};

/// The scene that a shared column is made with: its own contact between particles, whatever the run's is.
/// Requires scene.test.shared_columns.
Scene scene_of_column(const Scene& scene);

/// Which of the columns a run of this seed takes.
std::uint64_t number_of_column(const SharedColumns& columns, std::uint64_t seed);

/// The bodies turned about the z axis [rad].
std::vector<NewBody> turned(const std::vector<NewBody>& bodies, double angle);

/// Columns that runs side by side have made, so that each is made once. What a run gets does not depend on
/// it. The oldest go where there are more than kMost.
class ColumnShelf {
 public:
  /// The column of this name, made where it is not there; others who want it wait meanwhile. One whose making
  /// was interrupted is not kept.
  std::shared_ptr<const SharedColumn> get(const std::string& name, const std::function<SharedColumn()>& make);

 private:
  static constexpr std::size_t kMost = 256;
  struct Place {
    std::mutex making;
    std::shared_ptr<const SharedColumn> column;
  };
  std::shared_ptr<Place> place(const std::string& name);

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Place>> places_;
  std::deque<std::string> order_;
};

}  // namespace repose
