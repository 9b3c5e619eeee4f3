#pragma once

#include <string>
#include <vector>

#include "engine/shape/mesh.hpp"

namespace repose {

// Meshes of bodies whose volume, surface and inertia are known in closed form. Corners of curved surfaces lie
// on the surface, so that the mesh is a little smaller than the body. All around the origin, facets outwards.

/// Box of the given sides [m].
Mesh box_mesh(const Vec3& sides);
/// The tetrahedron with corners at the origin and at a, b, c [m] along the axes.
Mesh corner_tetrahedron(double a, double b, double c);
/// Corners at ± radius on the axes.
Mesh octahedron_mesh(double radius);
/// Semi-axes [m]; 20·4^level facets.
Mesh ellipsoid_mesh(const Vec3& semi_axes, int level);
/// Around z; R from the axis to the middle of the tube of radius r < R.
Mesh torus_mesh(double R, double r, int around, int across);

/// Closed surface that the curve (radius, height) makes by turning around z, `around` corners a ring. The
/// curve runs from the lowest to the highest point; both ends lie on the axis.
Mesh turned_mesh(const std::vector<Eigen::Vector2d>& curve, int around);
/// Cylinder of the length between the caps' centres, capped by half spheres.
Mesh capsule_mesh(double radius, double length, int around);
/// Cone of the base's radius and the height, its base at z = 0.
Mesh cone_mesh(double radius, double height, int around);

}  // namespace repose
