#include "engine/shape/clump_mass.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace repose {

namespace {

constexpr double kRoom = 2.0;
constexpr double kLeastShare = 0.01;

double ball(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }

/// Farthest point of the spheres from every axis through the origin.
Vec3 reach_from_axes(const Clump& clump) {
  Vec3 reach = Vec3::Zero();
  for (const Sphere& sphere : clump.spheres) {
    const Vec3 square = sphere.centre.cwiseAbs2();
    for (Eigen::Index k = 0; k < 3; ++k)
      reach[k] = std::max(reach[k], std::sqrt(std::max(square.sum() - square[k], 0.0)) + sphere.radius);
  }
  return reach;
}

}  // namespace

std::vector<MassFault> mass_faults(const Clump& clump) {
  std::vector<MassFault> faults;
  Eigen::AlignedBox3d box;
  double summed = 0.0;
  double largest = 0.0;
  for (const Sphere& sphere : clump.spheres) {
    box.extend(Vec3(sphere.centre.array() - sphere.radius));
    box.extend(Vec3(sphere.centre.array() + sphere.radius));
    summed += ball(sphere.radius);
    largest = std::max(largest, sphere.radius);
  }
  if (!box.contains(Vec3(Vec3::Zero())))
    faults.push_back({"spheres", "do not lie around the origin, which must be the centre of mass"});
  if (clump.volume > kRoom * summed || clump.volume < kLeastShare * ball(largest))
    faults.push_back(
        {"mass",
         "does not fit the size of the spheres: lengths are in m, mass is density × volume, which "
         "spheres must fill by half or more"});
  const Vec3 reach = reach_from_axes(clump);
  const Vec3 most = kRoom * clump.volume * reach.cwiseAbs2();
  const double least = kLeastShare * 0.4 * ball(largest) * largest * largest;
  if ((clump.inertia.array() > most.array()).any() || clump.inertia.minCoeff() < least)
    faults.push_back({"inertia",
                      "does not fit the size of the spheres: lengths are in m, moments are density × ∫ r² dV "
                      "about x, y and z"});
  return faults;
}

}  // namespace repose
