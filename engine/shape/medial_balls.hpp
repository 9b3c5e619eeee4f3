#pragma once

#include <vector>

#include "engine/shape/clump.hpp"
#include "engine/shape/surface_samples.hpp"

namespace repose {

/// For every sample the largest ball that touches the surface there from inside: its centre lies on the
/// medial axis. Shrinking balls (Ma, Bae & Choi 2012): a ball through p along the inward normal is shrunk
/// until no other sample is inside by more than the tolerance, which keeps a rough surface from ending it at
/// once.
/// @param tolerance [length of the samples], e.g. the roughness that a clump cannot follow
std::vector<Sphere> medial_balls(const SurfaceSamples& samples, double tolerance);

}  // namespace repose
