#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/scene/scene.hpp"

namespace repose::test {

inline constexpr Material kGlass{2500.0, 1.0e7, 0.25};  ///< softened, so that steps are long

/// A scene of one material with equal particle–particle and particle–wall parameters.
inline Scene scene_of(std::vector<Clump> shapes, const Material& material, const ContactParameters& contact,
                      RollingModel rolling = RollingModel::type_a) {
  Scene scene;
  scene.particles.material = scene.walls = material;
  scene.particles.shapes = std::move(shapes);
  scene.contact.particle_particle = scene.contact.particle_wall = contact;
  scene.contact.rolling_model = rolling;
  return scene;
}

/// A clump of spheres with the mass properties of its spheres' sum (they may overlap), moved to its centre of
/// mass and turned into its principal frame.
inline Clump summed_clump(std::vector<Sphere> spheres) {
  Clump clump;
  clump.name = "sum";
  Vec3 centre = Vec3::Zero();
  for (const Sphere& s : spheres) {
    const double volume = 4.0 / 3.0 * kPi * s.radius * s.radius * s.radius;
    clump.volume += volume;
    centre += volume * s.centre;
  }
  centre /= clump.volume;
  Mat3 inertia = Mat3::Zero();
  for (const Sphere& s : spheres) {
    const double volume = 4.0 / 3.0 * kPi * s.radius * s.radius * s.radius;
    const Vec3 d = s.centre - centre;
    inertia +=
        volume * ((d.squaredNorm() + 0.4 * s.radius * s.radius) * Mat3::Identity() - d * d.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia);
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  clump.inertia = principal.eigenvalues();
  for (const Sphere& s : spheres) clump.spheres.push_back({axes.transpose() * (s.centre - centre), s.radius});
  return clump;
}

/// A lump of `count` overlapping spheres within about `size` of its centre, no two axes alike.
inline Clump random_clump(RandomStream& random, int count, double size) {
  std::vector<Sphere> spheres;
  for (int k = 0; k < count; ++k) {
    const double radius = size * random.uniform(0.35, 0.6);
    const Vec3 direction = random.rotation() * Vec3::UnitZ();
    spheres.push_back(
        {(size - radius) * Vec3(1.3 * direction.x(), direction.y(), 0.7 * direction.z()), radius});
  }
  return summed_clump(std::move(spheres));
}

/// The plane z = 0.
inline Wall floor_wall() { return Wall{}; }

/// A flat wall with its normal along −x and its surface in the plane x = `x`: the inside of a cylinder so
/// wide that its curvature is lost, and not so wide that its distance is lost in rounding; 1e6 of a sphere's
/// radius keeps both below 1e-5 of an overlap.
inline Wall side_wall(double x, double radius) {
  Wall wall;
  wall.kind = Wall::Kind::half_shell_plus;
  wall.radius = radius;
  wall.x_offset = x - radius;
  wall.z_low = -1.0e3;
  wall.z_high = 1.0e3;
  return wall;
}

}  // namespace repose::test
