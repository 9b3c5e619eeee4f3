#pragma once

#include <cstdint>

#include "engine/base/warning.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/slump/energy_floor.hpp"
#include "engine/slump/motion_watch.hpp"
#include "engine/slump/outcome.hpp"
#include "engine/slump/pour.hpp"
#include "engine/slump/shared_column.hpp"
#include "engine/slump/still_angle.hpp"

namespace repose {

/// The slump test as a protocol (article section 3.2): pour, settle, open, rest. The physics ends each stage:
/// the pour when all particles are in, settle and rest when the mean kinetic energy per body has stayed below
/// settle_energy_ratio × m g d or rest_energy_ratio × m g d for kHold, open when the walls are out of the
/// way. With numerics.rest_angle_change a heap whose angle stands still is at rest as well (StillAngle). A
/// stage that does not end within numerics.stage_time_limit ends the run `timed_out`; a test of more than
/// kMostSteps steps is `too_long`, at once where pouring and opening alone take that many.
///
/// With test.shared_columns the column has been filled and settled before, with a contact of its own. A run
/// takes the one that its seed names, turns it about its axis by an angle from its seed, so that no two runs
/// of a column are the same, and settles it with its own contact; its springs begin anew.
///
/// MotionWatch looks on and ends a run whose motion is unsound. A body that leaves over the cylinder's rim is
/// taken away and counted: no wall holds it there.
///
/// Strays do not count: a body that touches no other body and is as low as the base would be rolls for
/// itself, and the heap does not wait for it. Bodies that have fallen below the base's top cannot come back
/// and leave the simulation.
class SlumpTestRun {
 public:
  SlumpTestRun(const Scene& scene, std::uint64_t seed, const RunOptions& options);

  /// Runs all stages.
  void run();
  /// Runs the first two, after which column() is there; false: the run is over.
  bool fill();

  [[nodiscard]] Outcome outcome() const { return outcome_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  [[nodiscard]] const Pour& pour() const { return pour_; }
  /// The settled column just before opening.
  [[nodiscard]] const HeapSnapshot& column() const { return column_; }
  /// What the run itself has to say of its result, beside the diagnosis.
  [[nodiscard]] const std::vector<Warning>& warnings() const { return warnings_; }
  [[nodiscard]] const MotionDiagnosis& diagnosis() const { return watch_.diagnosis(); }
  /// Simulated time from the opening to rest [s].
  [[nodiscard]] double rest_time() const { return rest_time_; }

 private:
  static constexpr double kHold = 0.02;            ///< simulated time that rest must last [s]
  static constexpr double kCheckInterval = 5e-4;   ///< between looks at energies, strays and the inlet [s]
  static constexpr long kContactCheckSteps = 200;  ///< between looks at all contacts
  /// A day and more for a thousand bodies: beyond is a slip of units.
  static constexpr double kMostSteps = 1e9;
  static constexpr double kDensest = 0.9;          ///< solid fraction; spheres of 1 : 20 pack to 0.85
  static constexpr long kStopSteps = 256;          ///< between looks at RunOptions::stop
  static constexpr double kReportInterval = 0.01;  ///< between progress reports [s]
  static constexpr double kLongestWait = 0.25;     ///< for room at the inlet, then the cylinder is full [s]

  enum class Stage { pour, settle, open, rest };

  void build_walls();
  bool fits_into_the_cylinder();
  bool fits_into_the_steps();
  bool pour_stage();
  bool take_shared_column();
  [[nodiscard]] SharedColumn make_shared_column() const;
  bool settle_stage();
  bool open_stage();
  bool rest_stage();
  void open_walls();
  bool move_walls_away();
  [[nodiscard]] double opening_travel() const;  ///< of the walls until they are out of the way [m]
  [[nodiscard]] bool walls_out_of_the_way() const;

  /// Steps to the next look; false: the run is over (diverged or stopped).
  bool advance();
  /// Advances until the energy ratio has stayed below `limit`; false: the run is over. `since` receives when
  /// rest began.
  bool until_rest(double limit, const char* what, double& since);
  bool fail_without_rest(double limit, const char* what, const EnergyFloor& floor);
  [[nodiscard]] EnergyLevel energy_level() const;
  bool look();
  void drop_lost();
  void report();
  bool fail(Outcome outcome, std::string reason);
  bool fail(Verdict verdict);

  const Scene& scene_;
  std::uint64_t seed_;
  const RunOptions& options_;
  Simulation simulation_;
  Pour pour_;
  MotionWatch watch_;
  Stage stage_ = Stage::pour;
  long steps_per_check_ = 1;
  double mean_diameter_ = 0.0;
  long next_contact_check_ = 0;
  double next_report_ = 0.0;
  double next_frame_ = 0.0;
  double rest_time_ = 0.0;
  Outcome outcome_ = Outcome::completed;
  std::string reason_;
  std::vector<Warning> warnings_;
  std::optional<StillAngle> still_angle_;  ///< of the rest stage, where the scene asks for it
  HeapSnapshot column_;
};

}  // namespace repose
