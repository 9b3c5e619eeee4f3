#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "engine/shape/clump.hpp"
#include "engine/shape/union_of_spheres.hpp"

namespace repose {

/// No sphere gets smaller than this share of the equivalent diameter: it would set the time step of a whole
/// simulation for next to nothing.
inline constexpr double kLeastRadius = 0.02;

/// What a clump is to look like, in units of the body's equivalent diameter, centre of mass at the origin,
/// axes principal.
struct FitTarget {
  std::vector<Vec3> points;     ///< evenly spread over the body's surface
  double volume = 0.0;          ///< V of the body: π/6 in these units
  Vec3 moments = Vec3::Zero();  ///< principal moments of inertia, density 1
  double min_radius = 0.0;      ///< no sphere gets smaller, nor than kLeastRadius
  /// No sphere gets larger. The surface alone does not see to that: a huge sphere whose own surface runs
  /// through a thin body is near all of the body's points.
  double max_radius = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d room = {};  ///< no centre leaves it; an empty box bounds nothing
};

struct FitOptions {
  int iterations = 50;
  /// Weight of the mass properties against the surface: 0 fits the surface alone. A relative error ε of
  /// volume or moments costs (weight ε)², a surface off by δ diameters on the average δ².
  double mass_weight = 0.0;
  double tolerance = 1e-5;  ///< relative fall of the objective in one iteration that ends the fit
  int panels = 60;          ///< of unite()
};

/// Non-linear least squares over all centres and radii together (Levenberg–Marquardt on the normal
/// equations):
///   minimise  1/M Σ_s f(p_s)²  +  w² [ (V/V₀−1)² + |∫x dV|²/V₀² + Σ_kk (I_kk/I⁰_k − 1)² + Σ_k<l I_kl²/(I⁰_k
///   I⁰_l) ] f(p) = min_k (|p − c_k| − r_k)
/// f is the distance of a point of the body's surface from the clump: a gap where positive, a bump where
/// negative. V and I are those of the union (unite()). A row of the first sum has four entries, so that the
/// normal matrix is made directly; Eigen's own LevenbergMarquardt would factorise M × 4N dense rows.
/// @return the objective that was reached
double fit_spheres(std::vector<Sphere>& spheres, const FitTarget& target, const FitOptions& options);

/// f(p) of every point and the sphere that it belongs to.
struct SurfaceGaps {
  std::vector<double> gap;
  std::vector<std::size_t> owner;
};
SurfaceGaps surface_gaps(const std::vector<Sphere>& spheres, const std::vector<Vec3>& points);

}  // namespace repose
