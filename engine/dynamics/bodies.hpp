#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/record_vector.hpp"
#include "engine/base/vec3.hpp"
#include "engine/shape/clump.hpp"

namespace repose {

/// What a contact reads of a body, in one cache line.
struct alignas(64) BodyMotion {
  double velocity[3] = {};  ///< [m/s]
  double mass = 1.0;        ///< [kg]
  double w[3] = {};         ///< ω, world frame [rad/s]
  /// type_a_relative: contacts of the last step / smallest principal moment [1/(kg m²)]; type_c: mean
  /// principal moment
  double inertia_term = 0.0;
};

/// What half a step at the accelerations of the last step adds to a body's velocities, in one cache line
/// (velocity_verlet; zero otherwise).
struct alignas(64) BodyLead {
  double velocity[3] = {};  ///< [m/s]
  double unused_v = 0.0;
  double w[3] = {};  ///< [rad/s]
  double unused_w = 0.0;
};

/// What contacts add up on a body, in one cache line.
struct alignas(64) BodyLoad {
  double force[3] = {};   ///< [N], without gravity
  double rolling = 0.0;   ///< type_a: Σ μr |F_n| R_i [N m]
  double torque[3] = {};  ///< about the centre of mass, world frame [N m]
  double contacts = 0.0;  ///< number of sphere contacts with other bodies and walls

  BodyLoad& operator+=(const BodyLoad& more) {
    for (int k = 0; k < 3; ++k) force[k] += more.force[k], torque[k] += more.torque[k];
    rolling += more.rolling, contacts += more.contacts;
    return *this;
  }
};

/// Where a body's spheres are: the world axes of its principal frame times its scale, one column a row of
/// four, and its centre of mass, so that an offset is placed with four vector steps; and its scale. Two cache
/// lines. Bodies that are single spheres (Bodies::oriented) keep the columns they began with.
struct alignas(64) BodyAxes {
  double column[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  double position[4] = {0.0, 0.0, 0.0, 1.0};  ///< [m], and the body's scale
};

/// @param turn  body to world
BodyAxes body_axes(const Vec3& position, const Mat3& turn, double scale);

/// A body to be added.
struct NewBody {
  int shape = 0;
  double scale = 1.0;
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Quat orientation = Quat::Identity();
  Vec3 angular_velocity = Vec3::Zero();  ///< world [rad/s]
};

/// State of all bodies. Arrays of one double per body, padded with resting bodies to a multiple of kPadding
/// so that vector loops have no tail; plus the two records that contacts gather and scatter. Primary state:
/// position, velocity (motion[].velocity), angular momentum in the world frame, orientation. ω follows from
/// the last two.
struct Bodies {
  static constexpr std::size_t kPadding = 8;

  explicit Bodies(std::span<const Clump> clumps, double density);

  std::size_t count = 0;  ///< bodies; arrays hold padded() entries
  [[nodiscard]] std::size_t padded() const { return (count + kPadding - 1) / kPadding * kPadding; }

  std::vector<double> x, y, z;                             ///< centre of mass [m]
  std::vector<double> lx, ly, lz;                          ///< angular momentum, world [kg m²/s]
  std::vector<double> qw, qx, qy, qz;                      ///< orientation, body to world
  std::vector<double> inverse_i1, inverse_i2, inverse_i3;  ///< 1/principal moments [1/(kg m²)]
  std::vector<double> reach;                               ///< bounding radius about the centre of mass [m]
  std::vector<double> swing;  ///< largest distance of a sphere's centre from the centre of mass [m]
  /// Path of the body's fastest point so far, at least: Σ Δt |v| + swing Σ |turns| [m]. It bounds how far any
  /// of its spheres has come since any earlier value.
  std::vector<double> travel;
  std::vector<double> swung;  ///< the second term of travel [m]
  std::vector<double> pace;   ///< by how much travel grew at the last step [m]
  RecordVector<BodyMotion> motion;
  RecordVector<BodyLoad> load;
  RecordVector<BodyLead> lead;
  RecordVector<BodyAxes> axes;
  std::vector<double> scale;
  std::vector<int> shape;
  std::vector<int> id;  ///< in the order of adding, stays with the body

  std::vector<Clump> shapes;  ///< of scale 1
  double density = 0.0;       ///< [kg/m³]
  bool oriented = false;      ///< some shape is not a single sphere at its centre: orientations matter

  /// Appends a body; returns its index.
  std::size_t add(const NewBody& body);
  /// Keeps the bodies with keep[i] ≠ 0, in their order. Returns the new index of each old body, −1 for the
  /// dropped.
  std::vector<int> retain(std::span<const char> keep);

  /// The load at an offset in doubles.
  [[nodiscard]] BodyLoad& load_at(std::int32_t offset) { return load[static_cast<std::size_t>(offset) / 8]; }
  [[nodiscard]] Vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
  [[nodiscard]] Vec3 velocity(std::size_t i) const { return Vec3(motion[i].velocity); }
  [[nodiscard]] Vec3 angular_velocity(std::size_t i) const { return Vec3(motion[i].w); }
  [[nodiscard]] Quat orientation(std::size_t i) const { return {qw[i], qx[i], qy[i], qz[i]}; }
  /// Translational and rotational kinetic energy of body i [J].
  [[nodiscard]] double kinetic_energy(std::size_t i) const;
  [[nodiscard]] const std::vector<Sphere>& spheres(std::size_t i) const {
    return shapes[static_cast<std::size_t>(shape[i])].spheres;
  }

 private:
  void resize(std::size_t entries);
  template <class Visit>
  void for_each_array(Visit visit);
};

}  // namespace repose
