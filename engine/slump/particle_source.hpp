#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/scene/scene.hpp"

namespace repose {

/// A particle to be poured: which shape at which scale.
struct ParticleDraw {
  int shape = 0;
  double scale = 1.0;
  double mass = 0.0;  ///< [kg]
};

/// The particles of one test, in the order of pouring: shapes in equal numbers and size classes in their
/// shares, as exactly as whole numbers allow at every moment of the pour (each particle goes to the
/// combination that is most behind its share), volumes uniform within a class. The list ends where its mass
/// is nearest to the scene's total mass, with at least one particle.
std::vector<ParticleDraw> draw_particles(const Particles& particles, RandomStream& random);

}  // namespace repose
