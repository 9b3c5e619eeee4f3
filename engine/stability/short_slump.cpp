#include "engine/stability/short_slump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/slump/slump_test.hpp"
#include "engine/stability/method.hpp"

namespace repose {

namespace {

constexpr double kPourTime = 0.15;  ///< longest [s]
constexpr double kLongestStage = 1.0;
/// Another step packs another column: at sound steps the mean overlap was 0.7 to 2.2 times that of the
/// reference.
constexpr double kPackings = 1.75;

/// A snapshot's bodies, at rest, within the closed cylinder.
Simulation standing(const SettledColumn& column, const Scene& scene, double step) {
  Simulation simulation(scene, step);
  Wall base;
  base.radius = scene.test.base_radius;
  base.z_low = -scene.test.base_height;
  Wall cylinder;
  cylinder.kind = Wall::Kind::closed_shell;
  cylinder.radius = scene.test.cylinder_radius;
  cylinder.z_high = scene.test.cylinder_height;
  simulation.walls = {base, cylinder};
  for (const BodySnapshot& was : column.bodies.bodies) {
    NewBody body;
    body.shape = was.shape;
    body.scale = was.scale;
    body.position = was.position;
    body.orientation = was.orientation;
    simulation.add(body);
  }
  return simulation;
}

void survey_at_rest(SettledColumn& column) {
  Simulation simulation = standing(column, column.scene, *column.scene.numerics.time_step);
  MotionWatch watch(column.scene);
  const bool steps = simulation.step();
  const auto unsound = watch.check_contacts(simulation);
  if (!steps || unsound) {
    column.reason = unsound ? unsound->reason : "the column cannot be set up again";
    return;
  }
  const ContactSurvey survey = simulation.survey();
  column.largest_overlap = survey.largest_overlap;
  column.elastic_energy = survey.elastic_normal;
  column.stiffness_time = 1.0 / std::sqrt(watch.diagnosis().stiffest);
}

/// One try at one step; false: the energy ledger is off.
bool pour_and_settle(SettledColumn& column, std::uint64_t seed, const std::atomic<bool>* stop) {
  RunOptions options;
  options.stop = stop;
  SlumpTestRun run(column.scene, seed, options);
  const bool settled = run.fill();
  const MotionDiagnosis& seen = run.diagnosis();
  column.interrupted = run.outcome() == Outcome::interrupted;
  if (!settled && !column.interrupted) {
    column.reason = fmt::format("{}: {}", name_of(run.outcome()), run.reason());
    return run.outcome() != Outcome::unstable && run.outcome() != Outcome::diverged &&
           run.outcome() != Outcome::escaped;
  }
  column.reason.clear();
  column.bodies = run.column();
  column.mean_overlap = seen.column_overlap_ratio;
  column.impact_stiffness_time = 1.0 / std::sqrt(seen.stiffest);
  return std::abs(seen.energy_imbalance) <= MotionDiagnosis::kLargeImbalance;
}

}  // namespace

Scene shortened(const Scene& scene, int bodies) {
  Scene small = scene;
  small.test.shared_columns.reset();  // one column is all there is
  double volume = 0.0, reach = 0.0;
  const Particles& particles = scene.particles;
  for (const Clump& shape : particles.shapes) {
    double mean = shape.volume, largest = shape.volume;
    if (!particles.size_classes.empty()) mean = largest = 0.0;
    for (const SizeClass& size : particles.size_classes) {
      mean += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
      largest = std::max(largest, size.volume_max);
    }
    volume += mean / static_cast<double>(particles.shapes.size());
    reach = std::max(reach, std::cbrt(largest / shape.volume) * shape.bounding_radius());
  }
  const double mass = std::min(particles.total_mass, bodies * volume * particles.material.density);
  const double f = std::cbrt(mass / particles.total_mass);
  if (f >= 1.0) return small;
  SlumpTest& test = small.test;
  small.particles.total_mass = mass;
  const double wide = std::max(f * test.cylinder_radius, std::min(2.5 * reach, test.cylinder_radius));
  const double widened = wide / (f * test.cylinder_radius);
  test.cylinder_radius = wide;
  test.base_radius *= f * widened;
  test.base_height = std::min(test.base_height, 2.0 * reach);
  test.cylinder_height =
      std::min(test.cylinder_height, std::max(1.5 * f * test.cylinder_height, 6.0 * reach));
  test.pour_rate = mass / std::min(kPourTime, particles.total_mass / test.pour_rate * std::sqrt(f));
  test.opening_speed *= std::sqrt(f);
  small.numerics.stage_time_limit = std::min(small.numerics.stage_time_limit, kLongestStage);
  return small;
}

SettledColumn settle_column(const Scene& shortened, std::uint64_t seed, const std::atomic<bool>* stop) {
  SettledColumn column;
  column.scene = with_method(shortened, {Integrator::symplectic_euler, RollingModel::type_c});
  for (ContactParameters* contact :
       {&column.scene.contact.particle_particle, &column.scene.contact.particle_wall})
    contact->restitution = std::min(contact->restitution, 0.3);
  double step = 0.5 * automatic_time_step(column.scene);
  for (int attempt = 0; attempt < 3; ++attempt, step *= 0.5) {
    column.scene.numerics.time_step = step;
    if (pour_and_settle(column, seed, stop) || column.interrupted) break;
  }
  if (column.sound()) survey_at_rest(column);
  return column;
}

Experiment column_experiment(const SettledColumn& column, const Scene& scene, const Tolerance& tolerance,
                             const std::atomic<bool>* stop) {
  return [column, scene, tolerance, stop](double step) {
    Simulation simulation = standing(column, scene, step);
    const double hold = kHold * column.stiffness_time;
    return watch_steps(simulation, {.duration = hold,
                                    .look_interval = hold / 100.0,
                                    .energy = column.elastic_energy,
                                    .overlap = column.largest_overlap,
                                    .tolerance = tolerance,
                                    .stop = stop});
  };
}

Experiment slump_experiment(const SettledColumn& column, const Scene& scene, std::uint64_t seed,
                            const Tolerance& tolerance, const std::atomic<bool>* stop) {
  return [mean_overlap = column.mean_overlap, scene, seed, tolerance, stop](double step) {
    Scene at_step = scene;
    at_step.numerics.time_step = step;
    RunOptions options;
    options.stop = stop;
    SlumpTestRun run(at_step, seed, options);
    run.run();
    Probe probe;
    probe.step = step;
    probe.energy_error = run.diagnosis().energy_imbalance;
    probe.overlap = run.diagnosis().column_overlap_ratio / mean_overlap;
    switch (run.outcome()) {
      case Outcome::interrupted:
        probe.failure = Failure::interrupted;
        break;
      case Outcome::diverged:
        probe.failure = Failure::diverged;
        break;
      case Outcome::escaped:
      case Outcome::overfull:
        probe.failure = Failure::escaped;
        break;
      default:
        probe.failure = judge(probe, {tolerance.energy, tolerance.overlap + kPackings});
    }
    return probe;
  };
}

}  // namespace repose
