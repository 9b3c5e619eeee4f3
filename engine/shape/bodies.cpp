#include "engine/shape/bodies.hpp"

#include <cmath>

namespace repose {

Mesh box_mesh(const Vec3& sides) {
  Mesh mesh;
  mesh.name = "box";
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(
        Vec3((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5, ((corner >> 2) & 1) - 0.5).cwiseProduct(sides));
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Mesh corner_tetrahedron(double a, double b, double c) {
  return {"tetrahedron",
          {Vec3::Zero(), a * Vec3::UnitX(), b * Vec3::UnitY(), c * Vec3::UnitZ()},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

Mesh octahedron_mesh(double radius) {
  Mesh mesh;
  mesh.name = "octahedron";
  for (const double sign : {1.0, -1.0})
    for (Eigen::Index k = 0; k < 3; ++k) mesh.vertices.push_back(sign * radius * Vec3::Unit(k));
  mesh.facets = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  return mesh;
}

Mesh ellipsoid_mesh(const Vec3& semi_axes, int level) {
  Mesh mesh = icosphere(level);
  mesh.name = "ellipsoid";
  for (Vec3& vertex : mesh.vertices) vertex = vertex.cwiseProduct(semi_axes);
  return mesh;
}

Mesh torus_mesh(double R, double r, int around, int across) {
  Mesh mesh;
  mesh.name = "torus";
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * kPi * i / around;
      const double v = 2.0 * kPi * j / across;
      const double ring = R + r * std::cos(v);
      mesh.vertices.emplace_back(ring * std::cos(u), ring * std::sin(u), r * std::sin(v));
      mesh.facets.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.facets.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return mesh;
}

Mesh turned_mesh(const std::vector<Eigen::Vector2d>& curve, int around) {
  Mesh mesh;
  mesh.name = "turned";
  const int rings = static_cast<int>(curve.size()) - 2;
  mesh.vertices.emplace_back(0.0, 0.0, curve.front().y());
  for (int ring = 1; ring <= rings; ++ring) {
    const Eigen::Vector2d& point = curve[static_cast<std::size_t>(ring)];
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * kPi * i / around;
      mesh.vertices.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, curve.back().y());
  const auto index = [&](int ring, int i) {
    return static_cast<std::uint32_t>(1 + ring * around + i % around);
  };
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int i = 0; i < around; ++i) {
    mesh.facets.push_back({0, index(0, i + 1), index(0, i)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.facets.push_back({index(ring, i), index(ring, i + 1), index(ring + 1, i + 1)});
      mesh.facets.push_back({index(ring, i), index(ring + 1, i + 1), index(ring + 1, i)});
    }
    mesh.facets.push_back({index(rings - 1, i), index(rings - 1, i + 1), top});
  }
  return mesh;
}

Mesh capsule_mesh(double radius, double length, int around) {
  std::vector<Eigen::Vector2d> curve;
  const int quarter = around / 4;
  for (int side = -1; side <= 1; side += 2) {
    for (int i = 0; i <= quarter; ++i) {
      const double angle = 0.5 * kPi * (side < 0 ? i - quarter : i) / quarter;
      curve.emplace_back(radius * std::cos(angle), radius * std::sin(angle) + 0.5 * side * length);
    }
  }
  Mesh mesh = turned_mesh(curve, around);
  mesh.name = "capsule";
  return mesh;
}

Mesh cone_mesh(double radius, double height, int around) {
  Mesh mesh = turned_mesh({{0.0, 0.0}, {radius, 0.0}, {0.0, height}}, around);
  mesh.name = "cone";
  return mesh;
}

}  // namespace repose
