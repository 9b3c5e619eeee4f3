#pragma once

#include <functional>
#include <string>

#include "engine/base/input_error.hpp"
#include "engine/shape/mesh.hpp"

namespace repose {

/// How a facet of the mesh, numbered from 0, is called in a message.
using FacetName = std::function<std::string(std::size_t)>;
/// "facet 1" for the first.
std::string facet_number(std::size_t facet);

/// What makes a mesh no body, each fault with its facet: no facets; a facet
/// without area; an edge that one facet has alone (open) or more than two share; facets turned against the
/// others, or all of them inwards; several separate surfaces; facets that cross; no volume. Empty for a good
/// mesh. At most `kNamedFaults` of a kind are named, the rest are counted. Cost: O(F log F) for a mesh
/// without long thin facets.
/// @param file     how the mesh is called in the message
/// @param name_of  how its facets are, e.g. by the face and line of a file whose faces are cut into several
Faults check_mesh(const Mesh& mesh, const std::string& file, const FacetName& name_of = facet_number);

}  // namespace repose
