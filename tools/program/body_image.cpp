#include "tools/program/body_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace repose::program {

namespace {

const Vec3 kMeshColour(0.72, 0.55, 0.45);
const Vec3 kSphereColour(0.45, 0.60, 0.75);

/// World to eye: x to the right, y up, z towards the eye.
Mat3 view() {
  const Vec3 toward = Vec3(0.5, -0.75, 0.45).normalized();
  const Vec3 right = Vec3::UnitZ().cross(toward).normalized();
  Mat3 rows;
  rows << right.transpose(), toward.cross(right).transpose(), toward.transpose();
  return rows;
}

}  // namespace

BodyImage::BodyImage(int bodies, double reach)
    : width_(bodies * kSide),
      scale_(0.5 * kSide / reach),
      depth_(static_cast<std::size_t>(width_) * kSide, -std::numeric_limits<double>::infinity()),
      pixels_(3 * depth_.size(), 255) {}

void BodyImage::shade(int square, int column, int row, double depth, const Vec3& normal, const Vec3& colour) {
  if (column < 0 || column >= kSide || row < 0 || row >= kSide) return;
  const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(square * kSide + column);
  if (depth <= depth_[at]) return;
  depth_[at] = depth;
  const Vec3 light = Vec3(-0.5, 0.6, 0.7).normalized();
  const double brightness = 0.30 + 0.75 * std::max(0.0, normal.dot(light));
  for (std::size_t k = 0; k < 3; ++k)
    pixels_[3 * at + k] = static_cast<std::uint8_t>(
        std::lround(255.0 * std::clamp(brightness * colour[static_cast<Eigen::Index>(k)], 0.0, 1.0)));
}

void BodyImage::draw(int square, const Mesh& mesh) {
  const Mat3 eye = view();
  for (const auto& [ia, ib, ic] : mesh.facets) {
    const Vec3 a = scale_ * eye * mesh.vertices[ia];
    const Vec3 b = scale_ * eye * mesh.vertices[ib];
    const Vec3 c = scale_ * eye * mesh.vertices[ic];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    if (normal.z() <= 0.0) continue;
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    const auto floor_of = [](double x) { return static_cast<int>(std::floor(x)); };
    for (int y = floor_of(std::min({a.y(), b.y(), c.y()}));
         y <= floor_of(std::max({a.y(), b.y(), c.y()})) + 1; ++y) {
      for (int x = floor_of(std::min({a.x(), b.x(), c.x()}));
           x <= floor_of(std::max({a.x(), b.x(), c.x()})) + 1; ++x) {
        const double u = ((x - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (y - a.y())) / area;
        const double v = ((b.x() - a.x()) * (y - a.y()) - (x - a.x()) * (b.y() - a.y())) / area;
        if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9) continue;
        shade(square, x + kSide / 2, y + kSide / 2, a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z()), normal,
              kMeshColour);
      }
    }
  }
}

void BodyImage::draw(int square, const std::vector<Sphere>& spheres) {
  const Mat3 eye = view();
  for (const Sphere& sphere : spheres) {
    const Vec3 centre = scale_ * eye * sphere.centre;
    const double radius = scale_ * sphere.radius;
    for (int y = static_cast<int>(centre.y() - radius); y <= static_cast<int>(centre.y() + radius) + 1; ++y) {
      for (int x = static_cast<int>(centre.x() - radius); x <= static_cast<int>(centre.x() + radius) + 1;
           ++x) {
        const Eigen::Vector2d from(x - centre.x(), y - centre.y());
        const double square_of_height = radius * radius - from.squaredNorm();
        if (square_of_height < 0.0) continue;
        const double height = std::sqrt(square_of_height);
        shade(square, x + kSide / 2, y + kSide / 2, centre.z() + height,
              Vec3(from.x(), from.y(), height) / radius, kSphereColour);
      }
    }
  }
}

}  // namespace repose::program
