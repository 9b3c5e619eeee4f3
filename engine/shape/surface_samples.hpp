#pragma once

#include <cstddef>
#include <vector>

#include "engine/shape/mesh.hpp"

namespace repose {

/// Points spread evenly over a mesh's surface.
struct SurfaceSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< of the facet, outwards, length 1
};

/// Equal shares of the area: point i stands where the area summed over the facets passes (i + ½)/count, at a
/// place in its facet from the additive recurrence of the plastic number (Roberts 2018). No random numbers.
SurfaceSamples sample_surface(const Mesh& mesh, std::size_t count);

}  // namespace repose
