#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/shape/clump_generator.hpp"
#include "engine/shape/facet_tree.hpp"
#include "engine/shape/union_of_spheres.hpp"

namespace repose {

namespace {

constexpr int kPanels = 400;

struct SurfaceDistance {
  double mean = 0.0;
  double worst = 0.0;
};

/// Distances of points spread over the exposed surface of the clump (Fibonacci spirals, one share of area
/// each).
SurfaceDistance surface_distance(const std::vector<Sphere>& spheres, const FacetTree& tree, double diameter) {
  constexpr double kPointsPerSquare = 1200.0;  // points on an area of diameter²
  const double golden_angle = 2.0 * kPi * (1.0 - 1.0 / std::numbers::phi);
  SurfaceDistance result;
  double area = 0.0;
  for (const Sphere& sphere : spheres) {
    const double own = 4.0 * kPi * sphere.radius * sphere.radius;
    const auto count = static_cast<int>(std::max(64.0, kPointsPerSquare * own / (diameter * diameter)));
    for (int i = 0; i < count; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / count;
      const double ring = std::sqrt(1.0 - z * z);
      const Vec3 direction(ring * std::cos(golden_angle * i), ring * std::sin(golden_angle * i), z);
      const Vec3 point = sphere.centre + sphere.radius * direction;
      const bool covered = std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& other) {
        return &other != &sphere && (point - other.centre).squaredNorm() < other.radius * other.radius;
      });
      if (covered) continue;
      const double distance = tree.distance(point);
      area += own / count;
      result.mean += own / count * distance;
      result.worst = std::max(result.worst, distance);
    }
  }
  if (area > 0.0) result.mean /= area;
  return result;
}

/// Mean over the principal axes of |I_mesh − I| / I_mesh.
double eit_error(const Vec3& mesh, const Mat3& clump) {
  const Vec3 moments = principal_frame(clump).moments;
  return (moments - mesh).cwiseAbs().cwiseQuotient(mesh).mean();
}

}  // namespace

ClumpErrors clump_errors(const std::vector<Sphere>& spheres, const Mesh& body) {
  const MeshMeasures mesh = measure(body);
  const Vec3 moments = principal_frame(mesh.inertia()).moments;
  const double diameter = mesh.equivalent_diameter();
  const MassProperties coarse = mass_properties(unite(spheres, kPanels).moments);
  const UnionOfSpheres fine = unite(spheres, 2 * kPanels);
  const MassProperties clump = mass_properties(fine.moments);

  ClumpErrors errors;
  errors.volume_error = std::abs(clump.volume / mesh.volume - 1.0);
  errors.eit_error = eit_error(moments, clump.inertia);
  // Twice the panels: what changed bounds what is left.
  errors.computation_error =
      std::max(std::abs(coarse.volume - clump.volume) / mesh.volume,
               ((principal_frame(coarse.inertia).moments - principal_frame(clump.inertia).moments).cwiseAbs())
                   .cwiseQuotient(moments)
                   .maxCoeff());
  errors.centre_offset = (clump.centre - mesh.centroid).norm() / diameter;
  const SurfaceDistance surface = surface_distance(spheres, FacetTree(body), diameter);
  errors.mean_distance = surface.mean / diameter;
  errors.max_distance = surface.worst / diameter;
  errors.sphericity = std::cbrt(36.0 * kPi * clump.volume * clump.volume) / fine.area;
  return errors;
}

}  // namespace repose
