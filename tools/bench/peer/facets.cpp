#include "tools/bench/peer/facets.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/shape/clump_export.hpp"

namespace repose::peer {

namespace {

/// Radius of the corners of a polygon that has the circle's area.
double corner_radius(double radius, int corners) {
  const double sector = 2.0 * kPi / corners;
  return radius * std::sqrt(sector / std::sin(sector));
}

Vec3 on_circle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// The strip between two upright lines, cut into pieces about as high as four widths.
void add_strip(Facets& facets, const Vec3& left, const Vec3& right, double z_low, double z_high) {
  const double width = (right - left).norm();
  const int pieces = std::max(1, static_cast<int>(std::round((z_high - z_low) / (4.0 * width))));
  const auto at = [](Vec3 point, double z) {
    point.z() = z;
    return point;
  };
  for (int k = 0; k < pieces; ++k) {
    const double low = z_low + (z_high - z_low) * k / pieces;
    const double high = z_low + (z_high - z_low) * (k + 1) / pieces;
    facets.push_back({at(left, low), at(right, low), at(right, high)});
    facets.push_back({at(left, low), at(right, high), at(left, high)});
  }
}

}  // namespace

Facets disc(double radius, double z, int rings) {
  const double corner = corner_radius(radius, 6 * rings);
  // Ring i has 6 i points; within a sixth of it, point j of ring i lies between points j − 1 and j of ring i
  // − 1.
  const auto point = [&](int sixth, int ring, int j) {
    if (ring == 0) return Vec3(0.0, 0.0, z);
    return on_circle(corner * ring / rings, kPi / 3.0 * (sixth + static_cast<double>(j) / ring), z);
  };
  Facets facets;
  for (int sixth = 0; sixth < 6; ++sixth)
    for (int ring = 1; ring <= rings; ++ring)
      for (int j = 0; j < ring; ++j) {
        facets.push_back({point(sixth, ring - 1, j), point(sixth, ring, j), point(sixth, ring, j + 1)});
        if (j + 1 < ring)
          facets.push_back(
              {point(sixth, ring - 1, j), point(sixth, ring, j + 1), point(sixth, ring - 1, j + 1)});
      }
  return facets;
}

Facets disc_side(double radius, double z_low, double z_high, int rings) {
  const int corners = 6 * rings;
  const double corner = corner_radius(radius, corners);
  Facets facets;
  for (int k = 0; k < corners; ++k)
    add_strip(facets, on_circle(corner, 2.0 * kPi * k / corners, 0.0),
              on_circle(corner, 2.0 * kPi * (k + 1) / corners, 0.0), z_low, z_high);
  return facets;
}

Facets half_shell(double radius, double z_low, double z_high, int side, int sectors) {
  const double sector = kPi / sectors;
  const double corner = radius / std::cos(0.5 * sector);
  const double first = side > 0 ? -0.5 * kPi : 0.5 * kPi;
  Facets facets;
  for (int k = 0; k < sectors; ++k)
    add_strip(facets, on_circle(corner, first + sector * k, 0.0),
              on_circle(corner, first + sector * (k + 1), 0.0), z_low, z_high);
  return facets;
}

void write_stl(const std::filesystem::path& file, const Facets& facets) {
  std::string text = "solid wall\n";
  const auto vertex = [](const Vec3& p) {
    return fmt::format("vertex {:.9e} {:.9e} {:.9e}\n", p.x(), p.y(), p.z());
  };
  for (const Facet& facet : facets) {
    const Vec3 normal = (facet.b - facet.a).cross(facet.c - facet.a).normalized();
    text +=
        fmt::format("facet normal {:.6e} {:.6e} {:.6e}\nouter loop\n{}{}{}endloop\nendfacet\n", normal.x(),
                    normal.y(), normal.z(), vertex(facet.a), vertex(facet.b), vertex(facet.c));
  }
  write_text(file, text + "endsolid wall\n");
}

}  // namespace repose::peer
