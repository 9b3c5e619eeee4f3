#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/scene.hpp"

namespace repose::peer {

/// One kind of particle: LIGGGHTS knows particles of fixed size only, as templates.
struct Template {
  int shape = 0;  ///< index into Particles::shapes
  double scale = 1.0;
  int count = 0;        ///< how many Repose pours
  double mass = 0.0;    ///< of one [kg]
  double volume = 0.0;  ///< of one [m³]
  Clump clump;          ///< at its size
};

/// The kinds of particles of a run and how many of each Repose pours. Throws InputError where sizes are drawn
/// from a range.
std::vector<Template> templates_of(const Scene& scene, std::uint64_t seed);

/// Whether every particle is one sphere about its own centre; otherwise all are multispheres.
bool all_spheres(const std::vector<Template>& templates);

double largest_reach(const std::vector<Template>& templates);

}  // namespace repose::peer
