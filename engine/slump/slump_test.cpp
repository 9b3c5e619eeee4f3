#include "engine/slump/slump_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/scene/canonical.hpp"

namespace repose {

namespace {

// Order of the walls in the simulation.
constexpr int kBase = 0, kCylinder = 1, kHalfPlus = 2, kHalfMinus = 3;

double mean_diameter(const std::vector<ParticleDraw>& particles, double density) {
  double sum = 0.0;
  for (const ParticleDraw& particle : particles) sum += std::cbrt(6.0 * particle.mass / (density * kPi));
  return sum / static_cast<double>(particles.size());
}

// A floor of the kinetic energy below a hundredth of m g d is a jitter of bodies that lie; above, they still
// fly.
constexpr double kJitter = 1e-2;

// A run's stream beside those of the pour (pour.cpp).
constexpr std::uint64_t kTurnStream = 3;

constexpr const char* kStageNames[] = {"pour", "settle", "open", "rest"};

}  // namespace

SlumpTestRun::SlumpTestRun(const Scene& scene, std::uint64_t seed, const RunOptions& options)
    : scene_(scene),
      seed_(seed),
      options_(options),
      simulation_(scene, time_step(scene), options.crew),
      pour_(scene, scene.test.shared_columns ? number_of_column(*scene.test.shared_columns, seed) : seed),
      watch_(scene) {
  steps_per_check_ = std::max(1L, static_cast<long>(std::min(kCheckInterval / simulation_.dt(), kMostSteps)));
  mean_diameter_ = mean_diameter(pour_.particles(), scene.particles.material.density);
  build_walls();
}

void SlumpTestRun::build_walls() {
  const SlumpTest& test = scene_.test;
  Wall base;
  base.radius = test.base_radius;
  base.z_low = -test.base_height;
  Wall cylinder;
  cylinder.kind = Wall::Kind::closed_shell;
  cylinder.radius = test.cylinder_radius;
  cylinder.z_high = test.cylinder_height;
  simulation_.walls = {base, cylinder};
  if (test.kind != TestKind::split_cylinder) return;
  Wall half = cylinder;
  half.present = false;
  half.kind = Wall::Kind::half_shell_plus;
  simulation_.walls.push_back(half);
  half.kind = Wall::Kind::half_shell_minus;
  simulation_.walls.push_back(half);
}

void SlumpTestRun::run() {
  if (!(fill() && open_stage() && rest_stage())) return;
  if (const auto verdict = watch_.check_contacts(simulation_)) fail(*verdict);
}

bool SlumpTestRun::fill() {
  return fits_into_the_cylinder() && fits_into_the_steps() &&
         (scene_.test.shared_columns ? take_shared_column() : pour_stage()) && settle_stage();
}

bool SlumpTestRun::fits_into_the_cylinder() {
  const SlumpTest& test = scene_.test;
  const double room = kPi * test.cylinder_radius * test.cylinder_radius * test.cylinder_height;
  const double share = pour_.total_mass() / scene_.particles.material.density / room;
  if (share <= kDensest) return true;
  return fail(
      Outcome::overfull,
      fmt::format("the particles' own volume is {:.0f} % of the cylinder's (no packing has more than {:.0f} "
                  "%); pour less or use a larger cylinder",
                  100.0 * share, 100.0 * kDensest));
}

/// The pour and the opening take their time whatever the bodies do; that alone may be too long.
bool SlumpTestRun::fits_into_the_steps() {
  const SlumpTest& test = scene_.test;
  const double pouring = pour_.total_mass() / test.pour_rate;
  const double opening = test.opening == Opening::instant ? 0.0 : opening_travel() / test.opening_speed;
  const double steps = (pouring + opening) / simulation_.dt();
  if (steps <= kMostSteps) return true;
  return fail(
      Outcome::too_long,
      fmt::format("pouring takes {:.3g} s and opening {:.3g} s, {:.3g} steps of {:.3g} s (bar: {:.0e}); "
                  "use a larger step or softer particles, or pour and open faster",
                  pouring, opening, steps, simulation_.dt(), kMostSteps));
}

bool SlumpTestRun::pour_stage() {
  stage_ = Stage::pour;
  while (!pour_.done()) {
    pour_.advance(simulation_);
    // What comes in at once may stand higher than the cylinder until it has settled: a collar holds it.
    Wall& cylinder = simulation_.walls[kCylinder];
    cylinder.z_high = std::max(cylinder.z_high, pour_.top());
    if (pour_.has_no_room() || pour_.waiting(simulation_) > kLongestWait)
      return fail(Outcome::overfull, fmt::format("the cylinder is full: {:.3g} of {:.3g} kg found room in "
                                                 "it; pour less or use a larger cylinder",
                                                 pour_.poured_mass(), pour_.total_mass()));
    if (!advance()) return false;
  }
  return true;
}

bool SlumpTestRun::take_shared_column() {
  stage_ = Stage::pour;
  const auto make = [this] { return make_shared_column(); };
  std::shared_ptr<const SharedColumn> column;
  if (options_.columns) {
    const std::string name = digest(canonical_text(scene_of_column(scene_))) + "/" +
                             std::to_string(number_of_column(*scene_.test.shared_columns, seed_));
    column = options_.columns->get(name, make);
  } else {
    column = std::make_shared<const SharedColumn>(make());
  }
  warnings_ = column->warnings;
  watch_.go_on_from(column->diagnosis);
  if (column->verdict.outcome != Outcome::completed) return fail(column->verdict);
  const double angle = 2.0 * kPi * RandomStream(seed_, kTurnStream).uniform();
  pour_.place(simulation_, turned(column->bodies, angle), column->strain);
  return true;
}

SharedColumn SlumpTestRun::make_shared_column() const {
  const Scene scene = scene_of_column(scene_);
  RunOptions options;
  options.on_progress = options_.on_progress;
  options.stop = options_.stop;
  options.crew = options_.crew;
  SlumpTestRun run(scene, number_of_column(*scene_.test.shared_columns, seed_), options);
  const bool filled = run.fill();
  SharedColumn column;
  column.diagnosis = run.diagnosis();
  column.warnings = run.warnings();
  if (!filled) {
    const bool stopped = run.outcome() == Outcome::interrupted;
    column.verdict = {run.outcome(), (stopped ? "" : "the shared column: ") + run.reason()};
    return column;
  }
  for (const BodySnapshot& body : run.column().bodies)
    column.bodies.push_back({.shape = body.shape,
                             .scale = body.scale,
                             .position = body.position,
                             .orientation = body.orientation});
  column.strain = run.simulation().survey().elastic_normal;
  return column;
}

bool SlumpTestRun::settle_stage() {
  stage_ = Stage::settle;
  double since = 0.0;
  if (!until_rest(scene_.numerics.settle_energy_ratio, "the column", since)) return false;
  column_ = simulation_.snapshot();
  if (const auto verdict = watch_.check_column(simulation_)) return fail(*verdict);
  const Bodies& bodies = simulation_.bodies();
  for (std::size_t i = 0; i < bodies.count; ++i)
    if (bodies.z[i] > scene_.test.cylinder_height)
      return fail(
          Outcome::overfull,
          fmt::format("the settled column is higher than the cylinder's {:.0f} mm; pour less or use a "
                      "larger cylinder",
                      1e3 * scene_.test.cylinder_height));
  simulation_.walls[kCylinder].z_high = scene_.test.cylinder_height;
  return true;
}

void SlumpTestRun::open_walls() {
  std::vector<Wall>& walls = simulation_.walls;
  const double speed = scene_.test.opening_speed;
  if (scene_.test.kind == TestKind::lifted_cylinder) {
    walls[kCylinder].kind = Wall::Kind::open_shell;
    walls[kCylinder].velocity = {0.0, 0.0, speed};
    return;
  }
  walls[kCylinder].present = false;
  for (const int half : {kHalfPlus, kHalfMinus}) {
    walls[static_cast<std::size_t>(half)].present = true;
    walls[static_cast<std::size_t>(half)].velocity = {half == kHalfPlus ? speed : -speed, 0.0, 0.0};
  }
  simulation_.split_wall(kCylinder, kHalfPlus, kHalfMinus);
}

/// Halves are out of the way once they have passed the base's edge (on an unbounded base four radii, where a
/// heap of the column's height ends). A lifted cylinder is once it is above every body: at the latest, its
/// own height up.
double SlumpTestRun::opening_travel() const {
  const SlumpTest& test = scene_.test;
  if (test.kind == TestKind::lifted_cylinder) return test.cylinder_height;
  return std::isinf(test.base_radius) ? 4.0 * test.cylinder_radius : test.base_radius + test.cylinder_radius;
}

bool SlumpTestRun::walls_out_of_the_way() const {
  if (scene_.test.kind == TestKind::split_cylinder)
    return simulation_.walls[kHalfPlus].x_offset > opening_travel();
  const Bodies& bodies = simulation_.bodies();
  for (std::size_t i = 0; i < bodies.count; ++i)
    if (bodies.z[i] + bodies.reach[i] > simulation_.walls[kCylinder].z_low) return false;
  return true;
}

bool SlumpTestRun::open_stage() {
  stage_ = Stage::open;
  const double begin = simulation_.time();
  watch_.open();
  if (scene_.test.opening == Opening::moved && !move_walls_away()) return false;
  for (std::size_t wall = kCylinder; wall < simulation_.walls.size(); ++wall)
    simulation_.walls[wall].present = false;
  rest_time_ = begin;
  return true;
}

bool SlumpTestRun::move_walls_away() {
  open_walls();
  const double begin = simulation_.time();
  const double travel =
      (scene_.test.cylinder_height + 4.0 * scene_.test.cylinder_radius) / scene_.test.opening_speed;
  while (!walls_out_of_the_way()) {
    if (!advance()) return false;
    if (simulation_.time() - begin > scene_.numerics.stage_time_limit + travel)
      return fail(Outcome::timed_out, fmt::format("the cylinder was not out of the way after {:.3g} s",
                                                  simulation_.time() - begin));
  }
  return true;
}

bool SlumpTestRun::rest_stage() {
  stage_ = Stage::rest;
  const double opened = rest_time_;
  double since = 0.0;
  if (const auto change = scene_.numerics.rest_angle_change) still_angle_.emplace(*change);
  if (!until_rest(scene_.numerics.rest_energy_ratio, "the heap", since)) return false;
  rest_time_ = since - opened;
  return true;
}

bool SlumpTestRun::until_rest(double limit, const char* what, double& since) {
  const double begin = simulation_.time();
  const double longest = scene_.numerics.stage_time_limit;
  EnergyFloor floor;
  bool quiet = false;
  for (;;) {
    if (!advance()) return false;
    const double now = simulation_.time();
    const EnergyLevel level = energy_level();
    floor.add((now - begin) / longest, level);
    if (!(level.ratio <= limit))
      quiet = false;
    else if (!quiet)
      quiet = true, since = now;
    if (quiet && now - since >= kHold) return true;
    if (still_angle_ && still_angle_->due(now)) {
      if (const auto still = still_angle_->look(now, measure_heap(simulation_.snapshot(), scene_.measure))) {
        since = *still;
        return true;
      }
    }
    if (now - begin > longest) return fail_without_rest(limit, what, floor);
  }
}

/// Why there is no rest: energy that still falls fast enough needs time; a floor far below one diameter's
/// fall is a jitter that no time ends; a higher one is a motion that nothing brakes.
bool SlumpTestRun::fail_without_rest(double limit, const char* what, const EnergyFloor& floor) {
  std::string reason = fmt::format(
      "{} has not come to rest within {:.3g} s: kinetic energy per body is {:.2g} m g d, rest is below "
      "{:.2g}; ",
      what, scene_.numerics.stage_time_limit, energy_level().ratio, limit);
  const auto level = floor.level(limit);
  if (scene_.numerics.stage_time_limit < std::sqrt(2.0 * scene_.test.cylinder_height / kGravity)) {
    reason += "a fall through the cylinder takes longer: allow more time (/numerics/stage_time_limit_s)";
  } else if (!level) {
    reason += "it still falls: allow more time (/numerics/stage_time_limit_s)";
  } else if (level->ratio > kJitter) {
    reason += "it hardly falls: nothing brakes the bodies; give them restitution below 1 and friction";
  } else {
    const std::string text = fmt::format(
        "the bodies jitter: their energy stays at {:.2g} m g d ({:.0f} % of it rotation); {}", level->ratio,
        100.0 * level->rotation,
        watch_.diagnosis().stability_number > watch_.diagnosis().coarse
            ? fmt::format("use a smaller step (its stability number is {:.1f}, coarse from {:.0f} on)",
                          watch_.diagnosis().stability_number, watch_.diagnosis().coarse)
            : "use the rolling model type_c or type_a, a smaller step, or an energy ratio in numerics above "
              "that");
    warnings_.push_back({"jitter", text});
    reason += text;
  }
  return fail(Outcome::timed_out, std::move(reason));
}

bool SlumpTestRun::advance() {
  for (long k = 0; k < steps_per_check_; ++k) {
    if (k % kStopSteps == 0 && options_.stop && options_.stop->load(std::memory_order_relaxed))
      return fail(Outcome::interrupted, "interrupted");
    if (!simulation_.step())
      return fail(Outcome::diverged,
                  fmt::format("the motion diverged at {:.4g} s with a step of {:.3g} s; use a smaller one",
                              simulation_.time(), simulation_.dt()));
  }
  if (!look()) return false;
  report();
  if (static_cast<double>(simulation_.steps()) > kMostSteps)
    return fail(Outcome::too_long,
                fmt::format("{:.3g} steps of {:.3g} s, and not at rest after {:.4g} s; use a larger step or "
                            "softer particles, or a shorter /numerics/stage_time_limit_s",
                            static_cast<double>(simulation_.steps()), simulation_.dt(), simulation_.time()));
  return true;
}

/// Everything that can be wrong between two steps, then bodies that have left for good go.
bool SlumpTestRun::look() {
  if (const auto verdict = watch_.check_bodies(simulation_)) return fail(*verdict);
  if (simulation_.steps() >= next_contact_check_) {
    next_contact_check_ = simulation_.steps() + kContactCheckSteps;
    if (const auto verdict = watch_.check_contacts(simulation_)) return fail(*verdict);
  }
  drop_lost();
  return true;
}

EnergyLevel SlumpTestRun::energy_level() const {
  const Bodies& bodies = simulation_.bodies();
  const std::vector<char> touches = simulation_.touching_another();
  double energy = 0.0, moving = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const bool stray = !touches[i] && bodies.z[i] < bodies.reach[i];
    if (stray) continue;
    energy += bodies.kinetic_energy(i);
    moving += 0.5 * bodies.motion[i].mass * bodies.velocity(i).squaredNorm();
    mass += bodies.motion[i].mass;
  }
  if (!(mass > 0.0)) return {};
  return {energy / (mass * kGravity * mean_diameter_), energy > 0.0 ? 1.0 - moving / energy : 0.0};
}

void SlumpTestRun::drop_lost() {
  const Bodies& bodies = simulation_.bodies();
  const bool opened = stage_ == Stage::open || stage_ == Stage::rest;
  simulation_.remove_if([&](std::size_t i) {
    const bool over_rim = watch_.spilled(bodies, i);
    const bool gone = over_rim || (opened && bodies.z[i] + bodies.reach[i] < 0.0);
    if (over_rim) watch_.count_spilled(bodies, i);
    return gone;
  });
}

void SlumpTestRun::report() {
  const double now = simulation_.time();
  if (options_.on_frame && options_.frame_interval > 0.0 && now >= next_frame_) {
    options_.on_frame(simulation_.snapshot());
    next_frame_ += options_.frame_interval;
  }
  if (!options_.on_progress || now < next_report_) return;
  next_report_ = now + kReportInterval;
  options_.on_progress({kStageNames[static_cast<int>(stage_)], now, energy_level().ratio, simulation_.steps(),
                        static_cast<int>(simulation_.bodies().count),
                        pour_.poured_mass() / pour_.total_mass()});
}

bool SlumpTestRun::fail(Verdict verdict) { return fail(verdict.outcome, std::move(verdict.reason)); }

bool SlumpTestRun::fail(Outcome outcome, std::string reason) {
  outcome_ = outcome;
  reason_ = std::move(reason);
  return false;
}

}  // namespace repose
