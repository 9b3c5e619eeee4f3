#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose::peer {

struct Facet {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero(), c = Vec3::Zero();
};
using Facets = std::vector<Facet>;

/// Level disc at height z: `rings` rings of well-shaped triangles, its edge a polygon of 6 × rings corners
/// with the disc's area.
Facets disc(double radius, double z, int rings);

/// Upright side of that disc's polygon between two heights.
Facets disc_side(double radius, double z_low, double z_high, int rings);

/// The half of an upright cylinder that faces +x (side = 1) or −x (side = −1), as `sectors` strips around it.
/// The strips touch the cylinder from outside: a body that touches the cylinder from inside overlaps no strip
/// more, so that the one can take the other's place.
Facets half_shell(double radius, double z_low, double z_high, int side, int sectors);

/// Writes an STL file (text). Throws InputError where it cannot.
void write_stl(const std::filesystem::path& file, const Facets& facets);

}  // namespace repose::peer
