#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/base/vec3.hpp"
#include "engine/scene/heap_snapshot.hpp"
#include "support/random_packing.hpp"

namespace repose::testing {

/// What a synthetic heap looks like. Lengths in metres, angles in radians.
struct HeapRecipe {
  double angle = radians(30.0);  ///< of the straight flank along ±y
  double diameter = 0.007;       ///< mean, of a body
  double apex_height = 0.05;     ///< where the straight flanks would meet
  double stretch = 1.0;          ///< of the cone along x: tan(angle along x) = tan(angle) / stretch
  double tip_rounding =
      0.0;                  ///< share of the foot's radius where the tip is a paraboloid, tangent to the cone
  double toe_height = 0.0;  ///< share of the apex height below which the toe runs out to zero slope
  double base_radius = std::numeric_limits<double>::infinity();
  double centre_x = 0.0;
  double centre_y = 0.0;
  int floor_strays = 0;      ///< single bodies on the base, outside the foot
  int surface_strays = 0;    ///< single bodies that rest on the flank
  int flying_strays = 0;     ///< single bodies in the air
  int spheres_per_body = 1;  ///< above 1: lumps of overlapping spheres
  enum class Cut { centre, top } cut = Cut::centre;
  std::uint64_t seed = 1;
};

/// A heap cut from a random packing: a body stays if its centre of mass (or its highest point) lies under the
/// surface that the recipe describes. True angles: those of the straight flanks of that surface, which reach
/// from the toe to the rounded tip.
class SyntheticHeap {
 public:
  SyntheticHeap(const RandomPacking& packing, const HeapRecipe& recipe)
      : recipe_(recipe), random_(recipe.seed, 1) {
    snapshot.base_radius = recipe.base_radius;
    snapshot.base_height = 0.05;
    cut(packing);
    add_strays();
  }

  [[nodiscard]] double true_angle_x() const { return std::atan(std::tan(recipe_.angle) / recipe_.stretch); }
  [[nodiscard]] double true_angle_y() const { return recipe_.angle; }
  /// α_AOR: the mean over the four flanks.
  [[nodiscard]] double true_angle() const { return 0.5 * (true_angle_x() + true_angle_y()); }

  HeapSnapshot snapshot;

 private:
  /// Height of the surface; negative outside the foot.
  [[nodiscard]] double surface(double x, double y) const {
    const double slope = std::tan(recipe_.angle);
    const double foot = recipe_.apex_height / slope;
    const double r = std::hypot((x - recipe_.centre_x) / recipe_.stretch, y - recipe_.centre_y);
    const double r_tip = recipe_.tip_rounding * foot;
    if (r < r_tip) return recipe_.apex_height - 0.5 * slope * r_tip - 0.5 * slope * r * r / r_tip;
    const double z = recipe_.apex_height - slope * r;
    const double z_toe = recipe_.toe_height * recipe_.apex_height;
    if (z_toe == 0.0 || z > z_toe) return z;
    // A parabola tangent to the flank at z_toe and to the floor 2 z_toe / slope further out.
    const double rest = 1.0 - (r - (recipe_.apex_height - z_toe) / slope) * slope / (2.0 * z_toe);
    return rest > 0.0 ? z_toe * rest * rest : -1.0;
  }

  void cut(const RandomPacking& packing) {
    const double d = recipe_.diameter;
    const double slope = std::tan(recipe_.angle);
    const double reach = recipe_.stretch * (recipe_.apex_height / slope) * (1.0 + recipe_.toe_height) + d;
    const double turn = random_.uniform(0.0, 2.0 * kPi);
    const double c = std::cos(turn), s = std::sin(turn);
    const double shift_x = random_.uniform(), shift_y = random_.uniform();
    const int tiles = static_cast<int>(std::ceil(1.5 * reach / (packing.width() * d))) + 1;
    for (int tx = -tiles; tx <= tiles; ++tx) {
      for (int ty = -tiles; ty <= tiles; ++ty) {
        for (const PackedSphere& sphere : packing.spheres()) {
          const double u = (sphere.centre.x() + (tx + shift_x) * packing.width()) * d;
          const double v = (sphere.centre.y() + (ty + shift_y) * packing.width()) * d;
          const Vec3 centre(c * u - s * v + recipe_.centre_x, s * u + c * v + recipe_.centre_y,
                            sphere.centre.z() * d);
          if (std::hypot(centre.x(), centre.y()) > recipe_.base_radius) continue;
          const double level = centre.z() + (recipe_.cut == HeapRecipe::Cut::top ? sphere.radius * d : 0.0);
          if (level < surface(centre.x(), centre.y())) add_body(centre, sphere.radius * d);
        }
      }
    }
  }

  void add_strays() {
    const double foot = recipe_.stretch * recipe_.apex_height / std::tan(recipe_.angle);
    const double r = 0.5 * recipe_.diameter;
    const double outer = std::min(recipe_.base_radius, 2.0 * foot);
    for (int k = 0; k < recipe_.floor_strays; ++k) {
      const Vec3 at = ring(std::min(1.1 * foot, 0.95 * outer), outer);
      if (surface(at.x() + recipe_.centre_x, at.y() + recipe_.centre_y) < 0.0)
        add_body({at.x(), at.y(), r}, r);
    }
    for (int k = 0; k < recipe_.surface_strays; ++k) {
      const Vec3 at = ring(0.1 * foot, std::min(0.9 * foot, 0.9 * recipe_.base_radius)) +
                      Vec3(recipe_.centre_x, recipe_.centre_y, 0.0);
      const double z = surface(at.x(), at.y());
      if (z > 0.0) add_body({at.x(), at.y(), z + 1.8 * r}, r);
    }
    for (int k = 0; k < recipe_.flying_strays; ++k) {
      const Vec3 at = ring(0.0, outer);
      add_body({at.x(), at.y(), recipe_.apex_height * random_.uniform(1.3, 2.0)}, r);
    }
  }

  [[nodiscard]] Vec3 ring(double inner, double outer) {
    const double r = std::sqrt(random_.uniform(inner * inner, outer * outer));
    const double phi = random_.uniform(0.0, 2.0 * kPi);
    return {r * std::cos(phi), r * std::sin(phi), 0.0};
  }

  void add_body(const Vec3& centre, double radius) {
    BodySnapshot body;
    body.position = centre;
    body.orientation = random_.rotation();
    body.volume = 4.0 / 3.0 * kPi * radius * radius * radius;
    body.mass = 2500.0 * body.volume;
    const int index = static_cast<int>(snapshot.bodies.size());
    snapshot.bodies.push_back(body);
    if (recipe_.spheres_per_body == 1) {
      snapshot.spheres.push_back({centre, radius, index});
      return;
    }
    // A lump: spheres of 0.55 … 0.75 of the body's radius that touch its bounding sphere from inside.
    for (int k = 0; k < recipe_.spheres_per_body; ++k) {
      const double part = random_.uniform(0.55, 0.75) * radius;
      const Vec3 direction = random_.rotation() * Vec3::UnitZ();
      snapshot.spheres.push_back({centre + (radius - part) * direction, part, index});
    }
  }

  HeapRecipe recipe_;
  RandomStream random_;
};

}  // namespace repose::testing
