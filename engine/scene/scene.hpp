#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/model.hpp"
#include "engine/shape/clump.hpp"

namespace repose {

/// Elastic material.
struct Material {
  double density = 0.0;        ///< ρ [kg/m³]
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson_ratio = 0.0;  ///< ν [-]
};

/// Parameters of one kind of contact.
struct ContactParameters {
  double restitution = 0.0;       ///< e [-], 0 … 1
  double static_friction = 0.0;   ///< μs [-]
  double rolling_friction = 0.0;  ///< μr [-]
};

struct ContactModel {
  ContactParameters particle_particle;
  ContactParameters particle_wall;
  RollingModel rolling_model = RollingModel::type_a;
  TangentialHistory tangential_history = TangentialHistory::force;
  NormalDamping normal_damping = NormalDamping::with_tail;
  double rolling_damping_ratio = 0.3;  ///< η_r of type_c [-]
  RollingTorque rolling_torque = RollingTorque::limited;
};

/// A range of particle volumes with its share of all particles by number. A drawn volume is uniform in the
/// range.
struct SizeClass {
  double volume_min = 0.0;       ///< [m³]
  double volume_max = 0.0;       ///< [m³]; equal to volume_min for a class of one diameter
  double number_fraction = 0.0;  ///< [-], the classes of a scene sum to 1
};

struct Particles {
  Material material;
  std::vector<Clump> shapes;            ///< share the particles equally by number
  std::vector<SizeClass> size_classes;  ///< empty: each shape keeps its own size
  double total_mass = 0.0;              ///< [kg]
};

enum class TestKind { split_cylinder, lifted_cylinder };

/// How the particles come into the cylinder (engine/slump).
enum class Filling {
  pour,    ///< at the top, at the pour rate
  rain,    ///< all at once, loosely above each other, falling
  packing  ///< all at once, packed at random, at rest
};

/// How the cylinder goes once its column is at rest.
enum class Opening {
  moved,   ///< its halves part, or it is lifted, at the opening speed
  instant  ///< it is gone from one step to the next
};

/// Columns that are filled and settled once, all with one contact, and shared by the runs of a study
/// (engine/slump).
struct SharedColumns {
  int count = 1;
  ContactParameters contact{.restitution = 0.3, .static_friction = 0.5, .rolling_friction = 0.1};
};

struct SlumpTest {
  TestKind kind = TestKind::split_cylinder;
  Filling filling = Filling::pour;
  Opening opening = Opening::moved;
  double base_radius = std::numeric_limits<double>::infinity();  ///< [m]; infinite: an unbounded plane
  double base_height = 0.05;                                     ///< [m], above the ground
  double cylinder_radius = 0.0;                                  ///< inner [m]
  double cylinder_height = 0.0;                                  ///< [m]
  double pour_rate = 5.0;                                        ///< [kg/s]
  double pour_speed = 1.0;     ///< downward speed of a particle that is poured or rains [m/s]
  double opening_speed = 1.0;  ///< of each half, or of the lifted cylinder, where it is moved [m/s]
  std::optional<SharedColumns> shared_columns;  ///< without them every run fills its own
};

struct Numerics {
  /// Exactly one of the three: fraction × T_R (smallest sphere), a step in seconds, or neither for "auto".
  std::optional<double> time_step_fraction = 0.3;
  std::optional<double> time_step;  ///< [s]
  double stiffness_scale = 1.0;     ///< multiplies G of particles and walls
  Integrator integrator = Integrator::symplectic_euler;
  Arithmetic arithmetic = Arithmetic::double_precision;
  /// Mean kinetic energy per body over m g d below which a stage counts as at rest.
  double settle_energy_ratio = 1e-4;
  double rest_energy_ratio = 1e-5;
  /// The heap is also at rest where its angle has moved by less than this for a while (slump/) [rad].
  std::optional<double> rest_angle_change;
  double stage_time_limit = 5.0;  ///< simulated seconds a stage (settle, rest) may take beyond its start [s]
};

/// How a flank is read (measure/).
struct MeasureOptions {
  double window_low = 0.2;   ///< lower end of the flank, fraction of the heap's height
  double window_high = 0.8;  ///< upper end
};

/// One slump test as plain data: everything that can change its result but the seed.
struct Scene {
  std::string title;
  Particles particles;
  Material walls;
  ContactModel contact;
  SlumpTest test;
  Numerics numerics;
  MeasureOptions measure;
};

}  // namespace repose
