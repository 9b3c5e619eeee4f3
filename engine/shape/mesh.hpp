#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose {

/// Corners of one triangle, counter-clockwise seen from outside.
using Facet = std::array<std::uint32_t, 3>;

/// The surface of a body as triangles. Lengths in m once it has been read; a mesh of a table's row is in m
/// too.
struct Mesh {
  std::string name;
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<Facet> facets;   ///< indices into vertices
};

/// What a closed mesh measures, exact for its polyhedron (rounding apart).
struct MeshMeasures {
  double volume = 0.0;           ///< V [m³], positive where facets face outwards
  double area = 0.0;             ///< SA [m²]
  Vec3 centroid = Vec3::Zero();  ///< [m]
  Mat3 second = Mat3::Zero();    ///< ∫ (x−c)(x−c)ᵀ dV [m⁵]
  Vec3 extents = Vec3::Zero();   ///< of the box along the axes [m]

  /// Tensor of inertia about the centroid for density 1 [m⁵]: tr(S) 1 − S, S = second.
  [[nodiscard]] Mat3 inertia() const;
  [[nodiscard]] double equivalent_diameter() const;
  /// Ψ = (36 π V²)^{1/3} / SA (article eq. 10).
  [[nodiscard]] double sphericity() const;
};

/// Volume, centroid and second moments by the divergence theorem: the sum over facets (a, b, c) of the
/// tetrahedra that they span with a point o. With D = a·(b×c) from o:
///   V = Σ D/6,   V c = Σ D/24 (a+b+c),   ∫ x xᵀ dV = Σ D/120 (s sᵀ + a aᵀ + b bᵀ + c cᵀ),  s = a+b+c
/// o is the middle of the box, so that a body far from the origin loses no digits.
MeshMeasures measure(const Mesh& mesh);

/// Principal axes as the columns of a rotation, moments ascending (I_x ≤ I_y ≤ I_z).
struct PrincipalFrame {
  Mat3 axes = Mat3::Identity();  ///< det = +1; the component of largest size of x and y is positive
  Vec3 moments = Vec3::Zero();
};

/// @param tensor symmetric tensor of inertia about the centre of mass
PrincipalFrame principal_frame(const Mat3& tensor);

/// The mesh with its centre of mass at the origin and its principal axes along x, y, z.
Mesh in_principal_frame(const Mesh& mesh);

/// A sphere of radius 1 as a subdivided icosahedron: 20·4^level facets.
Mesh icosphere(int level);

}  // namespace repose
