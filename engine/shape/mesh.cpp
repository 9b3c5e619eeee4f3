#include "engine/shape/mesh.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <numbers>

namespace repose {

Mat3 MeshMeasures::inertia() const { return second.trace() * Mat3::Identity() - second; }

double MeshMeasures::equivalent_diameter() const { return std::cbrt(6.0 * volume / kPi); }

double MeshMeasures::sphericity() const { return std::cbrt(36.0 * kPi * volume * volume) / area; }

MeshMeasures measure(const Mesh& mesh) {
  MeshMeasures result;
  if (mesh.vertices.empty()) return result;
  Vec3 low = mesh.vertices.front();
  Vec3 high = low;
  for (const Vec3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  result.extents = high - low;
  const Vec3 origin = 0.5 * (low + high);

  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const Facet& facet : mesh.facets) {
    const Vec3 a = mesh.vertices[facet[0]] - origin;
    const Vec3 b = mesh.vertices[facet[1]] - origin;
    const Vec3 c = mesh.vertices[facet[2]] - origin;
    const double six_volumes = a.dot(b.cross(c));
    const Vec3 sum = a + b + c;
    result.volume += six_volumes / 6.0;
    result.area += 0.5 * (b - a).cross(c - a).norm();
    first += six_volumes / 24.0 * sum;
    second += six_volumes / 120.0 *
              (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  const Vec3 offset = first / result.volume;
  result.centroid = origin + offset;
  result.second = second - result.volume * offset * offset.transpose();
  return result;
}

PrincipalFrame principal_frame(const Mat3& tensor) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(tensor);
  PrincipalFrame frame{solver.eigenvectors(), solver.eigenvalues()};
  for (Eigen::Index k = 0; k < 2; ++k) {
    Eigen::Index largest = 0;
    frame.axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (frame.axes(largest, k) < 0.0) frame.axes.col(k) *= -1.0;
  }
  frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  return frame;
}

Mesh in_principal_frame(const Mesh& mesh) {
  const MeshMeasures body = measure(mesh);
  const Mat3 to_body = principal_frame(body.inertia()).axes.transpose();
  Mesh turned = mesh;
  for (Vec3& vertex : turned.vertices) vertex = to_body * (vertex - body.centroid);
  return turned;
}

namespace {

Mesh icosahedron() {
  constexpr double phi = std::numbers::phi;
  Mesh mesh;
  mesh.vertices = {{-1, phi, 0},  {1, phi, 0},  {-1, -phi, 0}, {1, -phi, 0}, {0, -1, phi},  {0, 1, phi},
                   {0, -1, -phi}, {0, 1, -phi}, {phi, 0, -1},  {phi, 0, 1},  {-phi, 0, -1}, {-phi, 0, 1}};
  for (Vec3& vertex : mesh.vertices) vertex.normalize();
  mesh.facets = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

}  // namespace

Mesh icosphere(int level) {
  Mesh mesh = icosahedron();
  mesh.name = "sphere";
  for (int step = 0; step < level; ++step) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return entry->second;
    };
    std::vector<Facet> finer;
    finer.reserve(4 * mesh.facets.size());
    for (const auto& [a, b, c] : mesh.facets) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.facets = std::move(finer);
  }
  return mesh;
}

}  // namespace repose
