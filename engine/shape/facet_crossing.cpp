#include "engine/shape/facet_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace repose {

namespace {

using Triangle = std::array<Vec3, 3>;

/// Six times the volume of the tetrahedron (a, b, c, d).
double orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a));
}

/// Whether the segment passes through the triangle's inside; ends and edges that touch do not count.
bool passes_through(const Vec3& from, const Vec3& to, const Triangle& t, double tolerance) {
  const double start = orientation(t[0], t[1], t[2], from);
  const double end = orientation(t[0], t[1], t[2], to);
  if (std::min(start, end) > -tolerance || std::max(start, end) < tolerance) return false;
  const double u = orientation(from, to, t[0], t[1]);
  const double v = orientation(from, to, t[1], t[2]);
  const double w = orientation(from, to, t[2], t[0]);
  return (u > tolerance && v > tolerance && w > tolerance) ||
         (u < -tolerance && v < -tolerance && w < -tolerance);
}

/// Whether two segments meet at a point inside both of them; parallel ones do not.
bool segments_meet(const std::array<Vec3, 2>& first, const std::array<Vec3, 2>& second, double size) {
  constexpr double kRounding = 1e-11;
  const Vec3 u = first[1] - first[0];
  const Vec3 v = second[1] - second[0];
  const Vec3 between = second[0] - first[0];
  const Vec3 normal = u.cross(v);
  const double square = normal.squaredNorm();
  if (square <= 1e-18 * u.squaredNorm() * v.squaredNorm()) return false;
  if (std::abs(between.dot(normal)) > kRounding * size * std::sqrt(square)) return false;
  const auto inside = [](double share) { return share > kRounding && share < 1.0 - kRounding; };
  return inside(between.cross(v).dot(normal) / square) && inside(between.cross(u).dot(normal) / square);
}

/// The edge of a facet opposite the one corner that it shares with another.
std::array<Vec3, 2> opposite_edge(const Facet& facet, const Facet& other, const Mesh& mesh) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::find(other.begin(), other.end(), facet[k]) != other.end())
      return {mesh.vertices[facet[(k + 1) % 3]], mesh.vertices[facet[(k + 2) % 3]]};
  return {};
}

/// Whether the third corners of two facets with a common edge lie on the same side of it in the same plane.
bool folded(const Facet& first, const Facet& second, const Mesh& mesh) {
  std::array<Vec3, 2> edge;
  std::size_t found = 0;
  Vec3 own = Vec3::Zero();
  Vec3 other = Vec3::Zero();
  for (const std::uint32_t corner : first) {
    if (std::find(second.begin(), second.end(), corner) != second.end())
      edge[found++] = mesh.vertices[corner];
    else
      own = mesh.vertices[corner];
  }
  for (const std::uint32_t corner : second)
    if (std::find(first.begin(), first.end(), corner) == first.end()) other = mesh.vertices[corner];
  const Vec3 along = (edge[1] - edge[0]).normalized();
  const auto off_edge = [&](const Vec3& p) {
    const Vec3 from = p - edge[0];
    return Vec3((from - from.dot(along) * along).normalized());
  };
  return off_edge(own).dot(off_edge(other)) > 1.0 - 1e-12;
}

}  // namespace

bool facets_cross(const Mesh& mesh, std::size_t f, std::size_t g) {
  const Facet& first = mesh.facets[f];
  const Facet& second = mesh.facets[g];
  const auto is_in = [](std::uint32_t corner, const Facet& facet) {
    return std::find(facet.begin(), facet.end(), corner) != facet.end();
  };
  const auto shared =
      std::count_if(first.begin(), first.end(), [&](std::uint32_t c) { return is_in(c, second); });
  if (shared == 3) return true;
  if (shared == 2) return folded(first, second, mesh);
  const auto triangle = [&](const Facet& facet) {
    return Triangle{mesh.vertices[facet[0]], mesh.vertices[facet[1]], mesh.vertices[facet[2]]};
  };
  const Triangle a = triangle(first);
  const Triangle b = triangle(second);
  double size = 0.0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max({size, (a[k] - a[0]).norm(), (b[k] - a[0]).norm()});
  // Facets with a common corner whose opposite edges meet have the way from the one to the other in common,
  // though no edge passes through an inside: so the sides of a star that is turned more than once.
  if (shared == 1 &&
      segments_meet(opposite_edge(first, second, mesh), opposite_edge(second, first, mesh), size))
    return true;
  // Rounding of a determinant of three edges no longer than size.
  const double tolerance = 1e-13 * size * size * size;
  for (std::size_t k = 0; k < 3; ++k) {
    // An edge that ends in a shared corner meets the other facet there; only the edge opposite can cross.
    const std::size_t next = (k + 1) % 3;
    if (!is_in(first[k], second) && !is_in(first[next], second) &&
        passes_through(a[k], a[next], b, tolerance))
      return true;
    if (!is_in(second[k], first) && !is_in(second[next], first) &&
        passes_through(b[k], b[next], a, tolerance))
      return true;
  }
  return false;
}

}  // namespace repose
