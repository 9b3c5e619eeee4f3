#pragma once

#include <vector>

#include "engine/base/random.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/slump/particle_source.hpp"

namespace repose {

/// Solid fractions before the column settles: of particles that rain, which then fall by about its height,
/// and of a packing, a little looser than poured columns are (README.md).
inline constexpr double kRainFraction = 0.25;
inline constexpr double kPackingFraction = 0.4;

/// Brings the particles into the cylinder, never overlapping what is there.
///
/// Filling::pour: at its top, random place across the opening, random orientation, downward at the pour
/// speed. Where the mouth is too narrow for the rate, particles wait for room. rain, packing: all at the
/// first call, by pack_cylinder(), with a solid fraction of kRainFraction and falling at the pour speed, or
/// of kPackingFraction and at rest. Both may reach above the rim.
class Pour {
 public:
  Pour(const Scene& scene, std::uint64_t seed);

  /// Adds all particles as they lie in a column that has been filled with them before.
  /// @param strain  elastic energy of their contacts [J]
  void place(Simulation& simulation, const std::vector<NewBody>& column, double strain);
  /// Adds the particles that are due since the last call.
  void advance(Simulation& simulation);

  [[nodiscard]] bool done() const { return next_ == particles_.size(); }
  /// How high the particles reach that came in all at once [m].
  [[nodiscard]] double top() const { return top_; }
  /// Whether the particles, or their solid volume alone, have no room.
  [[nodiscard]] bool has_no_room() const { return no_room_; }
  /// Simulated seconds since the last particle found room while one was waiting; 0 if none waits.
  [[nodiscard]] double waiting(const Simulation& simulation) const;
  [[nodiscard]] double poured_mass() const { return poured_mass_; }
  [[nodiscard]] double total_mass() const { return total_mass_; }
  [[nodiscard]] int total_bodies() const { return static_cast<int>(particles_.size()); }
  [[nodiscard]] const std::vector<ParticleDraw>& particles() const { return particles_; }

 private:
  void place_all(Simulation& simulation);
  bool try_to_place(Simulation& simulation, const ParticleDraw& particle);
  [[nodiscard]] bool fits(const Bodies& bodies, const NewBody& body, double reach) const;

  const Scene& scene_;
  RandomStream placement_;
  std::vector<ParticleDraw> particles_;
  std::size_t next_ = 0;
  double poured_mass_ = 0.0;
  double total_mass_ = 0.0;
  double last_success_ = 0.0;  ///< when a particle found room or none was due, simulated [s]
  double last_call_ = 0.0;
  double top_ = 0.0;
  bool no_room_ = false;
};

}  // namespace repose
