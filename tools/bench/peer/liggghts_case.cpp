#include "tools/bench/peer/liggghts_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/dynamics/time_step.hpp"
#include "engine/shape/clump_export.hpp"
#include "tools/bench/peer/facets.hpp"
#include "tools/bench/peer/templates.hpp"

namespace repose::peer {

namespace {

constexpr int kBaseRings = 10, kInletRings = 4, kSectors = 32;

/// Lengths that more than one part of the script needs [m].
struct Extent {
  double reach = 0.0;       ///< of the largest particle
  double far_x = 0.0;       ///< how far a half of the cylinder is pulled, or 0
  double lift = 0.0;        ///< how far the cylinder is lifted, or 0
  double half_width = 0.0;  ///< of the box
  double bottom = 0.0;      ///< of the box; a particle that crosses it is gone
  double top = 0.0;         ///< of the box
  double stream = 0.0;      ///< length of the stream of particles that is filled at a time
  double inlet = 0.0;       ///< height at which a particle is let go
  double skin = 0.0;        ///< of the neighbour lists
};

/// What costs LIGGGHTS least: a list holds for about 16 steps of the fastest fall, and is no longer than it
/// need be in a settled heap.
double skin_of(const SlumpTest& test, double dt, double reach) {
  const double fastest = std::sqrt(test.pour_speed * test.pour_speed + 2.0 * kGravity * test.cylinder_height);
  return std::clamp(32.0 * fastest * dt, 0.1 * reach, 0.6 * reach);
}

Extent extent_of(const SlumpTest& test, double dt, double reach) {
  const bool bounded = std::isfinite(test.base_radius);
  Extent extent;
  extent.reach = reach;
  // As far as Repose moves them: past the edge of the base, or above every particle.
  if (test.kind == TestKind::split_cylinder)
    extent.far_x = bounded ? test.base_radius + test.cylinder_radius : 4.0 * test.cylinder_radius;
  else
    extent.lift = test.cylinder_height;
  const double base = bounded ? test.base_radius : 8.0 * test.cylinder_radius;
  extent.half_width = std::max(base, extent.far_x + test.cylinder_radius) + 4.0 * reach;
  extent.bottom = bounded ? -2.0 * reach : -0.5 * reach;
  extent.stream = 3.2 * reach;  // the least that `fix insert/stream` takes is 3 times the reach
  extent.skin = skin_of(test, dt, reach);
  extent.inlet = std::max(test.cylinder_height - reach, reach);
  extent.top = std::max(test.cylinder_height + extent.lift, extent.inlet + extent.stream) + 2.0 * reach;
  return extent;
}

std::string rolling_name(RollingModel model) {
  return model == RollingModel::type_c_undamped ? "epsd2" : "cdt";
}

Faults faults_of(const Scene& scene) {
  Faults faults;
  const ContactModel& contact = scene.contact;
  if (contact.rolling_model != RollingModel::type_a_relative &&
      contact.rolling_model != RollingModel::type_c_undamped)
    faults.add(
        "", "/contact/rolling_model", "",
        "must be \"type_a_relative\" (`cdt`) or \"type_c_undamped\" (`epsd2`) to compare with LIGGGHTS");
  if (contact.tangential_history != TangentialHistory::displacement)
    faults.add("", "/contact/tangential_history", "", "must be \"displacement\" to compare with LIGGGHTS");
  if (contact.normal_damping != NormalDamping::with_tail)
    faults.add("", "/contact/normal_damping", "", "must be \"with_tail\" to compare with LIGGGHTS");
  if (scene.test.opening == Opening::instant)
    faults.add("", "/test/opening", "", "must be \"moved\" to compare with LIGGGHTS");
  return faults;
}

std::string head_text(const Extent& extent) {
  const double w = extent.half_width;
  return fmt::format(R"(units si
hard_particles yes
soft_particles yes
atom_style sphere
atom_modify map array
boundary f f f
newton off
communicate single vel yes
processors 1 1 1
region box block {0:.9g} {1:.9g} {0:.9g} {1:.9g} {2:.9g} {3:.9g} units box
create_box 2 box
neighbor {4:g} bin
neigh_modify delay 0
)",
                     -w, w, extent.bottom, extent.top, extent.skin);
}

/// Type 1 is the particles, type 2 the walls; two walls never touch, so their pair repeats the wall's values.
std::string law_text(const Scene& scene) {
  const double softness = scene.numerics.stiffness_scale;
  const auto young = [softness](const Material& m) {
    return 2.0 * softness * m.shear_modulus * (1.0 + m.poisson_ratio);
  };
  const Material& p = scene.particles.material;
  const Material& w = scene.walls;
  const ContactParameters& pp = scene.contact.particle_particle;
  const ContactParameters& pw = scene.contact.particle_wall;
  const auto pair = [](const char* id, const char* name, double inside, double wall) {
    return fmt::format("fix {} all property/global {} peratomtypepair 2 {:.9g} {:.9g} {:.9g} {:.9g}\n", id,
                       name, inside, wall, wall, wall);
  };
  return fmt::format("fix young all property/global youngsModulus peratomtype {:.9g} {:.9g}\n", young(p),
                     young(w)) +
         fmt::format("fix poisson all property/global poissonsRatio peratomtype {:.9g} {:.9g}\n",
                     p.poisson_ratio, w.poisson_ratio) +
         pair("restitution", "coefficientRestitution", pp.restitution, pw.restitution) +
         pair("friction", "coefficientFriction", pp.static_friction, pw.static_friction) +
         pair("rolling", "coefficientRollingFriction", pp.rolling_friction, pw.rolling_friction) +
         fmt::format("pair_style gran ${{laws}}\npair_coeff * *\ntimestep {:.9g}\n", time_step(scene)) +
         fmt::format("fix gravity all gravity {:g} vector 0. 0. -1.\n", kGravity);
}

/// One `wall/gran` holds every mesh: LIGGGHTS takes no second one, and taking it away would forget its
/// springs. The cylinder's facets stand from the beginning, as what they touch remembers its contacts then.
std::string wall_text(const SlumpTest& test) {
  const bool bounded = std::isfinite(test.base_radius), lifted = test.kind == TestKind::lifted_cylinder;
  std::vector<std::string> meshes;
  if (bounded) meshes.emplace_back("base");
  if (lifted)
    meshes.emplace_back("shell");
  else
    meshes.insert(meshes.end(), {"half_plus", "half_minus"});
  std::string text = bounded ? "" : "fix plane all wall/gran ${laws} primitive type 2 zplane 0.\n";
  for (const std::string& mesh : meshes)
    text += fmt::format("fix {0} all mesh/surface file {0}.stl type 2\n", mesh);
  return text + fmt::format("fix walls all wall/gran ${{laws}} mesh n_meshes {} meshes {}\n", meshes.size(),
                            fmt::join(meshes, " "));
}

std::string template_text(const Template& kind, std::size_t number, double density, std::uint64_t seed,
                          bool spheres) {
  if (spheres)
    return fmt::format(
        "fix kind{} all particletemplate/sphere {} atom_type 1 density constant {:.9g} radius constant "
        "{:.12g}\n",
        number, prime_seed(seed), density, kind.clump.spheres.front().radius);
  const Vec3 moments = density * kind.clump.inertia;
  return fmt::format(
      "fix kind{0} all particletemplate/multisphere {1} atom_type 1 density constant {2:.9g} nspheres {3} "
      "ntry 1000000 "
      "spheres file kind{0}.txt scale 1. type {0} mass {4:.9e} inertia_tensor {5:.9e} 0 0 {6:.9e} 0 {7:.9e} "
      "use_density\n",
      number, prime_seed(seed), density, kind.clump.spheres.size(), kind.mass, moments.x(), moments.y(),
      moments.z());
}

/// Particles of one size class at a share of the mass; LIGGGHTS fills a stretch of the stream above the inlet
/// at a time, and each particle falls freely from the inlet on.
std::string pour_text(const Scene& scene, const Extent& extent, const std::vector<Template>& kinds,
                      std::uint64_t seed) {
  const double density = scene.particles.material.density;
  const bool spheres = all_spheres(kinds);
  double mass = 0.0;
  int count = 0;
  for (const Template& kind : kinds) mass += kind.count * kind.mass, count += kind.count;
  std::string text, shares;
  std::uint64_t stream = 10 * seed;  // every random number generator wants a seed of its own
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    text += template_text(kinds[k], k + 1, density, stream++, spheres);
    shares += fmt::format(" kind{} {:.9f}", k + 1, kinds[k].count * kinds[k].mass / mass);
  }
  text += fmt::format("fix mix all particledistribution/discrete {} {}{}\n", prime_seed(stream++),
                      kinds.size(), shares);
  text += "fix inlet all mesh/surface/planar file inlet.stl type 2\n";
  text += spheres ? "fix motion all nve/sphere\n" : "fix motion all multisphere\n";
  text += fmt::format(
      "fix pour all insert/stream seed {} distributiontemplate mix nparticles {} massrate {:.9g} maxattempt "
      "200 "
      "overlapcheck yes all_in no vel constant 0. 0. {:.9g} orientation random insertion_face inlet "
      "extrude_length "
      "{:.9g}\n",
      prime_seed(stream), count, scene.test.pour_rate, -scene.test.pour_speed, extent.stream);
  return text;
}

std::string dump_text(const char* file, bool spheres) {
  return fmt::format(
      "dump shot all custom 1 {} id type {}x y z radius vx vy vz omegax omegay omegaz\n"
      "dump_modify shot format \"%d %d {}%.10g %.10g %.10g %.10g %.6g %.6g %.6g %.6g %.6g %.6g\"\n"
      "run 0\nundump shot\n",
      file, spheres ? "" : "id_multisphere ", spheres ? "" : "%d ");
}

std::string opening_text(const SlumpTest& test) {
  if (test.kind == TestKind::lifted_cylinder)
    return fmt::format("fix pull all move/mesh mesh shell linear 0. 0. {:.9g}\n", test.opening_speed);
  return fmt::format(
      "fix pull all move/mesh mesh half_plus linear {0:.9g} 0. 0.\n"
      "fix push all move/mesh mesh half_minus linear -{0:.9g} 0. 0.\n",
      test.opening_speed);
}

/// Out of the way the facets stay where they are: nothing reaches them any more. What was moved last is
/// released first.
std::string standing_text(const SlumpTest& test) {
  return test.kind == TestKind::lifted_cylinder ? "unfix pull\n" : "unfix push\nunfix pull\n";
}

std::string stages_text(const Scene& scene, const Extent& extent, const Schedule& schedule, bool spheres) {
  const double dt = time_step(scene);
  const long opening = std::lround(schedule.opening / dt);
  const long rest = std::max(0L, std::lround(schedule.end / dt) - opening);
  const double travel = (extent.far_x + extent.lift) / scene.test.opening_speed;
  const long open = std::min(rest, static_cast<long>(std::ceil(travel / dt)));
  std::string text = fmt::format("run {}\nunfix pour\n", opening) + dump_text(kColumnDump, spheres);
  text += opening_text(scene.test) + fmt::format("run {}\n", open) + standing_text(scene.test);
  return text + fmt::format("run {}\n", rest - open) + dump_text(kHeapDump, spheres);
}

void write_walls(const SlumpTest& test, const Extent& extent, const std::filesystem::path& folder) {
  if (std::isfinite(test.base_radius)) {
    Facets base = disc(test.base_radius, 0.0, kBaseRings);
    const Facets side =
        disc_side(test.base_radius, std::max(-test.base_height, 0.9 * extent.bottom), 0.0, kBaseRings);
    base.insert(base.end(), side.begin(), side.end());
    write_stl(folder / "base.stl", base);
  }
  write_stl(folder / "inlet.stl", disc(test.cylinder_radius - extent.reach, extent.inlet, kInletRings));
  Facets plus = half_shell(test.cylinder_radius, 0.0, test.cylinder_height, 1, kSectors);
  const Facets minus = half_shell(test.cylinder_radius, 0.0, test.cylinder_height, -1, kSectors);
  if (test.kind == TestKind::lifted_cylinder) {
    plus.insert(plus.end(), minus.begin(), minus.end());
    write_stl(folder / "shell.stl", plus);
  } else {
    write_stl(folder / "half_plus.stl", plus);
    write_stl(folder / "half_minus.stl", minus);
  }
}

}  // namespace

std::uint64_t prime_seed(std::uint64_t n) {
  const auto is_prime = [](std::uint64_t x) {
    for (std::uint64_t d = 3; d * d <= x; d += 2)
      if (x % d == 0) return false;
    return true;
  };
  std::uint64_t candidate = 10001 + 1000 * n;
  while (!is_prime(candidate)) candidate += 2;
  return candidate;
}

void write_liggghts_case(const Scene& scene, std::uint64_t seed, const Schedule& schedule,
                         const std::filesystem::path& folder) {
  Faults faults = faults_of(scene);
  std::vector<Template> kinds;
  try {
    kinds = templates_of(scene, seed);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();

  const bool spheres = all_spheres(kinds);
  const Extent extent = extent_of(scene.test, time_step(scene), largest_reach(kinds));
  write_walls(scene.test, extent, folder);
  if (!spheres)
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      // Whole lines of numbers only: the reader of `spheres file` knows no comments.
      std::string lines;
      for (const Sphere& s : kinds[k].clump.spheres)
        lines += fmt::format("{:.12e} {:.12e} {:.12e} {:.12e}\n", s.centre.x(), s.centre.y(), s.centre.z(),
                             s.radius);
      write_text(folder / fmt::format("kind{}.txt", k + 1), lines);
    }
  write_text(folder / kInputFile,
             fmt::format("# {}\n", scene.title) +
                 fmt::format("variable laws string \"model hertz tangential history rolling_friction {}\"\n",
                             rolling_name(scene.contact.rolling_model)) +
                 head_text(extent) + law_text(scene) + wall_text(scene.test) +
                 pour_text(scene, extent, kinds, seed) +
                 "thermo_style custom step atoms ke cpu\nthermo 10000\n" +
                 stages_text(scene, extent, schedule, spheres));
}

}  // namespace repose::peer
