#pragma once

#include <cstdint>
#include <string>

#include "engine/shape/mesh.hpp"

namespace repose {

/// What a scan says of a particle whose mesh is not at hand.
struct BodyFigures {
  Vec3 extents = Vec3::Zero();  ///< along x, y, z [m]
  double volume = 0.0;          ///< V [m³]
  double area = 0.0;            ///< SA [m²]
};

struct RockOptions {
  std::uint64_t seed = 1;
  std::string name = "rock";
  int subdivision = 4;       ///< 20·4^level facets
  int candidates = 64;       ///< shapes tried; the least stretched is taken
  double sharpness = 24.0;   ///< p of the rounding of edges; ∞ is a sharp polyhedron
  double roughness = 0.012;  ///< amplitude of the surface's waves over its radius [-]
};

struct Rock {
  Mesh mesh;
  double worst_error = 0.0;  ///< largest relative error of the five figures
  double stretch = 0.0;      ///< largest over smallest principal stretch of the random shape
};

/// A closed irregular body, like crushed ore, that has the five figures: faces broken at random, worn edges
/// and a rough surface,
///   r(u) = (Σ_i max(0, n_i·u / d_i)^p)^{-1/p} (1 + ε Σ_j cos(k_j·u + φ_j) √(2/m)),
/// star-shaped about its middle and so without self-intersection, then mapped by the linear map M (9
/// unknowns, which keeps it closed and simple) that meets the five figures, nearest to a pure scaling:
/// Gauss–Newton with the step of least norm. Deterministic in the seed. Throws InputError where no body can
/// have the figures (V above 36 π V² ≤ SA³, V above the box) or none of the candidates reaches them to 0.1 %.
/// @param file, pointer where the figures stand, for the message
Rock make_rock(const BodyFigures& figures, const RockOptions& options, const std::string& file,
               const std::string& pointer);

}  // namespace repose
