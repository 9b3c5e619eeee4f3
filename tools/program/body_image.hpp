#pragma once

#include <cstdint>
#include <vector>

#include "engine/shape/clump.hpp"
#include "engine/shape/mesh.hpp"

namespace repose::program {

/// Bodies side by side in one image: a square for each, seen from the same oblique direction, parallel
/// projection, matte surfaces lit from the upper left.
class BodyImage {
 public:
  /// @param bodies  squares side by side
  /// @param reach   half the width of a square [m]: the largest distance from the middle that is seen
  BodyImage(int bodies, double reach);

  /// Draws into the square of the given number, from 0, the body's origin in the middle.
  void draw(int square, const Mesh& mesh);
  void draw(int square, const std::vector<Sphere>& spheres);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return kSide; }
  /// Three bytes a pixel, rows from below.
  [[nodiscard]] const std::vector<std::uint8_t>& pixels() const { return pixels_; }

  static constexpr int kSide = 360;  ///< pixels of a square

 private:
  void shade(int square, int column, int row, double depth, const Vec3& normal, const Vec3& colour);

  int width_;
  double scale_;               ///< pixels per metre
  std::vector<double> depth_;  ///< of what is seen so far, towards the eye
  std::vector<std::uint8_t> pixels_;
};

}  // namespace repose::program
