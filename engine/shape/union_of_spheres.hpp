#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/shape/clump.hpp"

namespace repose {

/// Order of the ten moments: ∫ dV, then ∫ x, y, z dV, then ∫ xx, yy, zz, xy, xz, yz dV.
inline constexpr Eigen::Index kMoments = 10;
using Moments = Eigen::Matrix<double, kMoments, 1>;

/// Mass properties of the union of spheres, for density 1: what overlaps counts once.
struct UnionOfSpheres {
  Moments moments = Moments::Zero();
  double area = 0.0;            ///< of the union's surface [m²]
  std::vector<double> exposed;  ///< per sphere, its share of that surface [m²]; 0 where nothing can touch it
  /// ∂moments/∂(x, y, z, r) of every sphere, 10 × 4N; empty where it was not asked for.
  Eigen::MatrixXd gradient;
};

/// Cuts the union by planes z = const. A cut is a union of discs, whose area and moments are exact sums over
/// the arcs that no other disc covers (Green's theorem for homogeneous f of degree n: ∬ f dA = 1/(n+2) ∮ f (x
/// dy − y dx)); the integral over z is Gauss–Legendre of three points on panels that end where a sphere
/// begins or ends. The gradient needs the same arcs, since dA = r dφ dz on a sphere: ∂/∂r ∫ f dV = ∮ f dA,
/// ∂/∂c ∫ f dV = ∮ f n dA over the exposed part.
/// @param panels  at least so many panels over the union's height; the error falls as panels^−2.5 or faster
/// Cost: O(panels · N · neighbours). Source: arcs as in Gibson & Scheraga 1987, here for moments too.
UnionOfSpheres unite(std::span<const Sphere> spheres, int panels, bool with_gradient = false);

/// Volume, centre of mass and tensor of inertia about it, of ten moments.
struct MassProperties {
  double volume = 0.0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};
MassProperties mass_properties(const Moments& moments);

}  // namespace repose
