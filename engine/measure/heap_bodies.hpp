#pragma once

#include <vector>

#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// Diameter of the sphere of the body's volume, (6 V / π)^{1/3} [m].
double equivalent_diameter(const BodySnapshot& body);

/// False where a position, a mass, a volume or a sphere is infinite or not a number.
bool is_finite(const HeapSnapshot& heap);

/// Bodies whose centre of mass lies over the base (inside its radius, above z = 0).
std::vector<int> bodies_over_base(const HeapSnapshot& heap);

/// The bodies among candidates that belong to the heap: the part of greatest volume of those that lie
/// together. Two bodies lie together when their centres are within 3/4 of the sum of their equivalent
/// diameters, a gap of half a diameter between equal spheres; the others are strays. Indices rise.
std::vector<int> largest_cluster(const HeapSnapshot& heap, const std::vector<int>& candidates);

}  // namespace repose
