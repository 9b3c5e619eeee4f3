#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose {

struct Sphere {
  Vec3 centre = Vec3::Zero();  ///< [m], in the principal frame of the body, from its centre of mass
  double radius = 0.0;         ///< [m]

  [[nodiscard]] bool operator==(const Sphere& other) const {
    return centre == other.centre && radius == other.radius;
  }
};

/// A rigid body made of spheres, with the mass properties of what it represents, for density 1.
/// Centre of mass at the origin, axes principal. A body of density ρ that is scaled by s has mass ρ s³ volume
/// and moments ρ s⁵ inertia.
struct Clump {
  std::string name;
  std::vector<Sphere> spheres;
  double volume = 0.0;          ///< V [m³]
  Vec3 inertia = Vec3::Zero();  ///< ∫ (r² − x_k²) dV, k = x, y, z [m⁵]

  /// Radius of the sphere around the centre of mass that holds every sphere [m].
  [[nodiscard]] double bounding_radius() const;
  /// Diameter of the sphere of equal volume [m].
  [[nodiscard]] double equivalent_diameter() const;
  [[nodiscard]] double smallest_radius() const;
  /// Into how many groups the spheres fall between which gaps are wider than a tenth of the smaller radius:
  /// of more than one, others can pass through the body.
  [[nodiscard]] int groups() const;
};

/// The clump of one sphere: V = 4/3 π r³, I = 8/15 π r⁵.
Clump sphere_clump(double radius);

/// Reads a clump file (README.md holds the format). Spheres marked `inner` are left out: nothing can touch
/// them. Throws InputError with every fault: no spheres, a radius ≤ 0, two spheres alike, mass or moments ≤
/// 0, moments that break the triangle inequality, mass properties that no body of these spheres has
/// (mass_faults()), unknown keys, a key given twice.
Clump read_clump(const std::filesystem::path& file);

/// What a clump file holds beyond the clump itself.
struct ClumpFileExtras {
  double density = 1.0;                     ///< ρ [kg/m³] that mass and moments are written for
  std::vector<Sphere> inner = {};           ///< spheres that nothing can touch, written with "inner": true
  std::string made_by = {};                 ///< how it was made, for the reader of the file; may be empty
  std::optional<double> volume_error = {};  ///< [-]
  std::optional<double> eit_error = {};     ///< [-]
};

/// The text of a clump file; read_clump() gives back the same clump, bit for bit where ρ = 1.
std::string clump_text(const Clump& clump, const ClumpFileExtras& extras = {});

/// Writes clump_text() to a file, whose folder is made if there is none. Throws InputError where it cannot.
void write_clump(const std::filesystem::path& file, const Clump& clump, const ClumpFileExtras& extras = {});

}  // namespace repose
