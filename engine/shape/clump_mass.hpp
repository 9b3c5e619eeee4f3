#pragma once

#include <string>
#include <vector>

#include "engine/shape/clump.hpp"

namespace repose {

/// A mass property that does not fit the spheres of a clump.
struct MassFault {
  std::string key;  ///< of the clump file: spheres, mass, inertia
  std::string rule;
};

/// What of a clump's mass properties its spheres cannot have. A clump carries those of the body that it
/// stands for, which may stick out of few spheres or fill less than they do; so each rule has room, and what
/// is found are units mixed up, axes exchanged, coordinates from elsewhere than the centre of mass:
///   the centre of mass, the origin, lies in the box around the spheres: no body has it outside its hull;
///   V ≤ 2 Σ 4/3 π r³: at least half of the body is made of spheres;
///   V ≥ 1/100 of the largest sphere, the room that spheres marked `inner` and thick spheres of a thin body
///   need;
///   I_k ≤ 2 V max (√(c_i² + c_j²) + r)²: moments of a body whose points are that far from the axis k;
///   I_k ≥ 1/100 of 8/15 π r⁵ of the largest sphere.
/// generate_clump() refuses to make a clump that breaks one. Empty for a good clump. Requires spheres, V and
/// I that are positive numbers.
std::vector<MassFault> mass_faults(const Clump& clump);

}  // namespace repose
