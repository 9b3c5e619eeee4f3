#pragma once

#include <span>
#include <vector>

#include "engine/base/crew.hpp"
#include "engine/base/random.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/scene/scene.hpp"
#include "engine/slump/particle_source.hpp"

namespace repose {

/// All particles of a test at their places in the cylinder, none touching another or a wall.
struct Packing {
  std::vector<NewBody> bodies;  ///< at rest, in the order of the draws
  double top = 0.0;             ///< the highest point of a body [m]; may be above the cylinder's rim
  bool clear = false;           ///< false: no place without overlap was found
};

/// Packs particles at random in an endless upright cylinder that stands on z = 0.
///
/// Places and orientations are drawn evenly over a column of the solid fraction that is asked for. Then pairs
/// that overlap are pushed apart, each at its deepest pair of spheres along the normal n there: with r from
/// the body's middle to the contact,
///   λ = δ / (w_i + w_j),   w = (1 + |r × n|²/ρ²)/m,   x += λ n/m,   turned by λ (r × n)/(m ρ²)
/// (Müller, Macklin, Chentanez, Jeschke & Kim 2020, eqs. 2 to 9, with a sphere's moment, ρ² = 2/5 R² of its
/// volume). The column is open at its top, so that bodies find room; where they do not, it is stretched
/// upwards. A gap of kGap diameters is kept on the way, so that what is left of the overlaps at the end is
/// none: contacts of stiff particles would drive them apart.
///
/// Pairs are taken layer by layer, first those of every other layer, then the rest. Layers are so high that a
/// pair lies in two neighbouring ones, so that those of one go share no body and may be worked through at the
/// same time.
/// @param fraction  solid volume over the column's, 0 … 0.6; the result is at most as dense
/// @param crew      its members work together; the result does not depend on them, to the last bit
Packing pack_cylinder(const Particles& particles, std::span<const ParticleDraw> draws, double cylinder_radius,
                      double fraction, RandomStream& random, Crew& crew);

/// Gap that pack_cylinder() aims at, over the mean diameter of the particles.
inline constexpr double kPackingGap = 0.01;

}  // namespace repose
