#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.hpp"
#include "engine/slump/outcome.hpp"

namespace repose {

/// How far the motion of a run can be trusted, in numbers.
struct MotionDiagnosis {
  /// Of the energy ledger's relative imbalances, the one farthest from 0: what the step invented or lost [-].
  double energy_imbalance = 0.0;
  double largest_overlap_ratio = 0.0;  ///< δ over the smaller radius of a contact, at any look [-]
  /// Mean δ of the settled column's contacts over the mean diameter of the two bodies [-].
  double column_overlap_ratio = 0.0;
  double stability_number = 0.0;  ///< of the stiffest body at any look, see MotionWatch [-]
  double stiffest = 0.0;          ///< bound of Σ K/m of the same [1/s²]
  int spilled = 0;                ///< bodies that left over the cylinder's rim
  double spilled_mass = 0.0;      ///< [kg]

  /// Imbalance beyond which a result is worth less, and beyond which it may not rest on the motion. In 120
  /// runs of 300 spheres (type_a and type_c, e = 0 … 1, steps of 0.1 to 0.8 T_R) it grew with the step: 1 to
  /// 8 % where the motion was sound, 10 to 20 % where it was at its limit and the angle not yet off by more
  /// than its error, and 30 to 1e4 % beyond. Of type_a some is the ledger's own: 6 to 13 % where a tall
  /// cylinder is poured full at a sound step.
  static constexpr double kLargeImbalance = 0.1;
  static constexpr double kMostImbalance = 0.25;
  /// Mean overlap of the column beyond which it is too dense by more than 5 %, and beyond which the heap is
  /// no heap of these particles: in 8 runs each of 300 spheres at mean overlaps of 0.3, 1.2, 2.6, 3.7, 4.6
  /// and 5.7 % the density was 0, 5, 11, 17, 21 and 27 % above that of the first, and the angle 22.4
  /// ± 1.1, 22.3 ± 1.1, 21.0 ± 1.1, 19.6 ± 0.9, 18.4 ± 2.1 and 21.0 ± 0.9°.
  static constexpr double kSoft = 0.01;
  static constexpr double kDeepest = 0.03;
  static constexpr double kDensityPerOverlap = 5.0;  ///< Δρ/ρ over the mean overlap, from the same runs
  /// Stability number beyond which a step may be too large: in the same runs, μs = 0.5, all below it were
  /// sound, type_c jittered from 4 on, type_a made energy from 5.7 on. Where μs is above 1 contacts hardly
  /// slide and what friction would have cut off stays: energy was made from 2.1 on (μs = 1.5 and 5).
  static constexpr double kCoarse = 4.0;
  static constexpr double kCoarseSticking = 2.0;
  double coarse = kCoarse;  ///< the one of the two that holds for the scene
};

/// Why a run must end, with what to do.
struct Verdict {
  Outcome outcome = Outcome::completed;
  std::string reason;
};

/// Whether the motion up to `time` [s], with steps of dt [s], is beyond what a result may rest on.
std::optional<Verdict> judge(const MotionDiagnosis& diagnosis, double time, double dt);

/// Looks at the bodies between steps for what no sound motion does:
///
/// - numbers that are not finite: `diverged`;
/// - a centre of mass below the base's top well inside its edge, or outside the closed cylinder: `escaped`;
/// - an energy ledger that does not close: `unstable`;
/// - a settled column whose particles lie too deep in one another: `overlapping`.
///
/// Stability of the step: leapfrog with damping from the last velocities is stable where, for every motion,
///   Δt² K/m + 2 Δt C/m < 4
/// (an oscillator v ← v − Δt (K x + C v)/m, x ← x + Δt v). K/m is bounded by Σ over a body's contacts of
/// max(k_n (1/m + |arm × n|²/I), k_t (1/m + arm²/I)), twice for contacts with other bodies (both give way),
/// with k_n = 2 Y* √(R* δ), k_t = 8 G* √(R* δ) and I the least moment; C/m likewise with the damping γ √(S_n
/// m*). stability_number is the left side over 4, at its largest: below 1 the step is safe whatever the
/// packing, above it may not be.
class MotionWatch {
 public:
  explicit MotionWatch(const Scene& scene);

  /// The cylinder opens: bodies may be outside of it from now on.
  void open() { closed_ = false; }

  /// Cheap, for every look: finite numbers, bodies where no body can be.
  [[nodiscard]] std::optional<Verdict> check_bodies(const Simulation& simulation) const;
  /// Over all contacts, for some looks: energy and overlaps. Requires that no body was added or removed since
  /// the last step.
  [[nodiscard]] std::optional<Verdict> check_contacts(const Simulation& simulation);
  /// The same for a settled column; fills column_overlap_ratio.
  [[nodiscard]] std::optional<Verdict> check_column(const Simulation& simulation);

  /// Whether body i has left over the rim of the closed cylinder, above which no wall holds it.
  [[nodiscard]] bool spilled(const Bodies& bodies, std::size_t i) const;
  void count_spilled(const Bodies& bodies, std::size_t i);

  /// Goes on from what was seen of a column that was made before, maybe with other friction: what counts as
  /// coarse stays this scene's.
  void go_on_from(const MotionDiagnosis& diagnosis) {
    const double coarse = diagnosis_.coarse;
    diagnosis_ = diagnosis;
    diagnosis_.coarse = coarse;
  }

  [[nodiscard]] const MotionDiagnosis& diagnosis() const { return diagnosis_; }

 private:
  /// What is summed over all contacts that touch.
  struct ContactSums {
    double overlap_ratio_sum = 0.0;  ///< of δ over the bodies' mean diameter
    double largest_ratio = 0.0;      ///< of δ over the smaller radius
    int count = 0;
    std::vector<double> stiffness;  ///< bound of K/m by body [1/s²]
    std::vector<double> damping;    ///< bound of C/m by body [1/s]
  };
  [[nodiscard]] ContactSums sum_contacts(const Simulation& simulation) const;

  const Scene& scene_;
  MotionDiagnosis diagnosis_;
  bool closed_ = true;  ///< the cylinder has not been opened yet
};

}  // namespace repose
