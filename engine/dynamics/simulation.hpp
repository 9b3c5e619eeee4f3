#pragma once

#include <memory>
#include <vector>

#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/energy_ledger.hpp"
#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/integrate.hpp"
#include "engine/dynamics/shares.hpp"
#include "engine/dynamics/wall.hpp"
#include "engine/scene/heap_snapshot.hpp"
#include "engine/scene/scene.hpp"

namespace repose {

/// Rigid bodies among walls under gravity, stepped with a fixed Δt.
class Simulation {
 public:
  /// The particles, walls' material, contact model and numerics of a scene; no bodies and no walls yet.
  /// @param crew            the threads that make the steps; without one the caller's alone. Its leader calls
  /// step().
  ///                        The state does not depend on it, to the last bit.
  /// @param section_bodies  bodies of a Section, a multiple of Bodies::kPadding. The motion does not depend
  /// on it to the
  ///                        last bit; the ledger's sums are rounded otherwise.
  Simulation(const Scene& scene, double dt, std::shared_ptr<Crew> crew = nullptr,
             std::size_t section_bodies = Section::kBodies);

  /// One step: neighbours if needed, spheres placed, contact forces, integration, walls. Returns false once
  /// the motion has diverged (a coordinate is not finite or out of all bounds); the state is then
  /// meaningless.
  bool step();

  void add(const NewBody& body);
  /// Books the elastic energy that bodies bring with them which touch each other where they are added [J].
  void add_strain(double energy);
  /// Removes bodies for which `gone(index)` is true; returns how many.
  template <class Gone>
  int remove_if(Gone gone);

  /// Splits the wall `from` into the walls already added as `plus` and `minus`: contacts keep their history.
  void split_wall(int from, int plus, int minus);

  /// Where the energy has gone until the last step. Looks at every body and contact: about the cost of a few
  /// steps.
  [[nodiscard]] EnergyLedger ledger() const;
  /// Contacts of the last step.
  [[nodiscard]] ContactSurvey survey() const;

  /// For each body whether it touched another body at the last step.
  [[nodiscard]] std::vector<char> touching_another() const;

  /// State for measuring and writing. `shells` are filled from the walls that are present.
  [[nodiscard]] HeapSnapshot snapshot() const;

  [[nodiscard]] double time() const { return static_cast<double>(steps_) * dt_; }
  [[nodiscard]] double dt() const { return dt_; }
  [[nodiscard]] long steps() const { return steps_; }
  [[nodiscard]] const Bodies& bodies() const { return bodies_; }
  [[nodiscard]] const ContactList& contacts() const { return contacts_; }
  [[nodiscard]] const ForceStep& laws() const { return force_step_; }
  /// Those who make the steps, for other work between them.
  [[nodiscard]] Crew& crew() {
    crew_->admit();
    return *crew_;
  }

  std::vector<Wall> walls;  ///< may be added to and changed between steps

 private:
  void remove(std::span<const char> keep);
  // The phases of a step, each for one share of it.
  void place_spheres(const Share& share);
  void place_spheres(const Section& section);
  void pair_forces(Share& share);
  void move(Share& share);
  void take_loads(const Share& share, const Share& from);
  void book_tallies();
  void book(const ContactWork& work);

  double dt_;
  long steps_ = 0;
  RollingModel rolling_model_;
  MotionStep motion_step_;
  EnergyLedger booked_;  ///< its sums; friction and rolling_resistance with what springs hold
  ForceStep force_step_;
  ForceKernels kernels_;
  Bodies bodies_;
  ContactList contacts_;
  std::shared_ptr<Crew> crew_;
  std::vector<Share> shares_;
  long dealt_ = -1;  ///< ContactList::changes() when they were dealt out
  std::vector<SectionTally> tallies_;
};

template <class Gone>
int Simulation::remove_if(Gone gone) {
  std::vector<char> keep(bodies_.count, 1);
  int removed = 0;
  for (std::size_t i = 0; i < bodies_.count; ++i)
    if (gone(i)) keep[i] = 0, ++removed;
  if (removed > 0) remove(keep);
  return removed;
}

}  // namespace repose
