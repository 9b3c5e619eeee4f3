#pragma once

#include <cstddef>

#include "engine/shape/mesh.hpp"

namespace repose {

/// Whether two facets of a mesh have more in common than the corners or the edge that they share: an edge of
/// one passes through the inside of the other, they share a corner and the edges opposite to it meet, or they
/// share an edge and lie folded onto each other. Facets that only touch do not cross.
bool facets_cross(const Mesh& mesh, std::size_t f, std::size_t g);

}  // namespace repose
