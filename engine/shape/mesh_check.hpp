#pragma once

#include "engine/base/input_error.hpp"
#include "engine/shape/mesh.hpp"

namespace repose {

/// What makes a mesh no body, each fault with its facet (numbered from 1, as in the file): no facets; a facet
/// without area; an edge that one facet has alone (open) or more than two share; facets turned against the
/// others, or all of them inwards; several separate surfaces; facets that cross; no volume. Empty for a good
/// mesh. At most `kNamedFaults` of a kind are named, the rest are counted. Cost: O(F log F) for a mesh
/// without long thin facets.
/// @param file how the mesh is called in the message
Faults check_mesh(const Mesh& mesh, const std::string& file);

inline constexpr std::size_t kNamedFaults = 10;

}  // namespace repose
