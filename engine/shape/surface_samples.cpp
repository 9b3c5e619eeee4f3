#include "engine/shape/surface_samples.hpp"

#include <cmath>

namespace repose {

SurfaceSamples sample_surface(const Mesh& mesh, std::size_t count) {
  constexpr double kPlastic = 1.32471795724474602596;  // x³ = x + 1
  SurfaceSamples samples;
  samples.points.reserve(count);
  samples.normals.reserve(count);
  const double step = measure(mesh).area / static_cast<double>(count);
  double summed = 0.0;
  for (const auto& [ia, ib, ic] : mesh.facets) {
    const Vec3& a = mesh.vertices[ia];
    const Vec3 ab = mesh.vertices[ib] - a;
    const Vec3 ac = mesh.vertices[ic] - a;
    const Vec3 normal = ab.cross(ac);
    summed += 0.5 * normal.norm();
    while (samples.points.size() < count &&
           (static_cast<double>(samples.points.size()) + 0.5) * step <= summed) {
      const auto index = static_cast<double>(samples.points.size() + 1);
      double u = std::fmod(index / kPlastic, 1.0);
      double v = std::fmod(index / (kPlastic * kPlastic), 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      samples.points.push_back(a + u * ab + v * ac);
      samples.normals.push_back(normal.normalized());
    }
  }
  return samples;
}

}  // namespace repose
