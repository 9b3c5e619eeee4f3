#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr double kRollingBar = 1e-3;
constexpr double kRadius = 0.01;
constexpr double kStep = 2e-6;

/// A sphere that stands on the floor in equilibrium, 4/3 Y* √R δ^{3/2} = m g, and may move.
struct OnFloor {
  Scene scene;
  double mass, overlap, Y_eff;

  OnFloor(double friction, double rolling, RollingModel model) {
    const Material material{2500.0, 1e10, 0.25};
    scene = test::scene_of({sphere_clump(kRadius)}, material, {0.3, friction, rolling}, model);
    mass = material.density * scene.particles.shapes.front().volume;
    Y_eff = material.shear_modulus / (1.0 - material.poisson_ratio);  // Y / (2 (1 − ν²))
    overlap = std::pow(0.75 * mass * kGravity / (Y_eff * std::sqrt(kRadius)), 2.0 / 3.0);
  }
  [[nodiscard]] Simulation with(const Vec3& velocity, const Vec3& spin, double dt = kStep) const {
    Simulation simulation(scene, dt);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, kRadius - overlap};
    body.velocity = velocity;
    body.angular_velocity = spin;
    simulation.add(body);
    return simulation;
  }
};

/// A sphere set sliding: rolling begins at 2 u/(7 μ g) with 5/7 u, after 12 u²/(49 μ g). The last slip dies
/// within the relaxation time of the contact's spring and damper, 3e-5 s here, which u is chosen to leave
/// small.
Rows slip_to_roll() {
  Worst worst("slip to roll: time, speed and distance where rolling begins", "rigid-body dynamics",
              kRollingBar);
  for (const double friction : {0.1, 0.4})
    for (const double u : {1.0, 2.0}) {
      Simulation simulation = OnFloor(friction, 0.0, RollingModel::type_a).with({u, 0.0, 0.0}, Vec3::Zero());
      const Bodies& bodies = simulation.bodies();
      const auto slip = [&] { return bodies.velocity(0).x() - bodies.angular_velocity(0).y() * kRadius; };
      while (slip() > 0.0 && simulation.time() < 1.0) simulation.step();
      worst.add(2.0 * u / (7.0 * friction * kGravity), simulation.time());
      worst.add(12.0 * u * u / (49.0 * friction * kGravity), bodies.x[0]);
      for (int k = 0; k < 2000; ++k) simulation.step();
      worst.add(5.0 / 7.0 * u, bodies.velocity(0).x());
    }
  return {worst.row()};
}

/// type_a: the torque μr m g R slows a rolling sphere by μr g / 1.4 until it stands.
Rows stop_distance() {
  Rows rows;
  for (const auto model : {RollingModel::type_a, RollingModel::type_a_relative}) {
    Worst worst(model == RollingModel::type_a
                    ? "rolling to a stop, type_a: distance, time, speed on the way"
                    : "rolling to a stop, type_a_relative: distance, time, speed on the way",
                "constant torque", kRollingBar);
    for (const double rolling : {0.02, 0.1}) {
      const double u = 0.3, slowing = rolling * kGravity / 1.4;
      Simulation simulation = OnFloor(0.8, rolling, model).with({u, 0.0, 0.0}, {0.0, u / kRadius, 0.0});
      const Bodies& bodies = simulation.bodies();
      bool halfway = false;
      double stopped = 0.0;
      while (simulation.time() < 1.3 * u / slowing) {
        simulation.step();
        if (!halfway && simulation.time() > 0.5 * u / slowing) {
          halfway = true;
          worst.add(u - slowing * simulation.time(), bodies.velocity(0).x());
        }
        if (stopped == 0.0 && bodies.velocity(0).x() < 1e-5 * u) stopped = simulation.time();
      }
      worst.add(0.5 * u * u / slowing, bodies.x[0]);
      worst.add(u / slowing, stopped);
      worst.add(0.0, bodies.velocity(0).norm(), u);
    }
    rows.push_back(worst.row());
  }
  return rows;
}

/// type_c below its limit is a damped oscillator about the contact point: with I = 7/5 m R² and
/// k_r = 2.25 k_n μr² R², θ'' + 2 η ω θ' + ω² θ = 0, ω² = k_r/I. Then it rests.
Rows rolling_spring_oscillates() {
  Worst motion("type_c below its limit: path of the oscillation", "damped oscillator", kRollingBar);
  Worst rest("type_c: speed after ten relaxation times", "comes to rest", kRollingBar);
  const double mu = 0.02, eta = 0.3;
  OnFloor set(0.8, mu, RollingModel::type_c);
  set.scene.contact.rolling_damping_ratio = eta;
  const double inertia = 1.4 * set.mass * kRadius * kRadius;
  const double k_n = 4.0 / 3.0 * set.Y_eff * std::sqrt(kRadius * set.overlap);
  const double w = std::sqrt(2.25 * k_n * mu * mu * kRadius * kRadius / inertia),
               w_d = w * std::sqrt(1.0 - eta * eta);
  const double limit_angle = mu * kRadius * set.mass * kGravity / (inertia * w * w);
  const double spin = 0.5 * limit_angle * w;
  Simulation simulation = set.with({spin * kRadius, 0.0, 0.0}, {0.0, spin, 0.0}, 1e-7);
  while (w_d * simulation.time() < 4.0 * kPi) {
    simulation.step();
    const double t = simulation.time();
    const double path = kRadius * spin / w_d * std::exp(-eta * w * t) * std::sin(w_d * t);
    motion.add(path, simulation.bodies().x[0], kRadius * spin / w);
  }
  while (eta * w * simulation.time() < 10.0) simulation.step();
  rest.add(0.0, simulation.bodies().angular_velocity(0).norm(), spin);
  return {motion.row(), rest.row()};
}

/// A rolling sphere is stopped by the fully mobilised spring, swings back and rests: farthest point and end
/// of the path against small steps of the same scalar equation.
Rows rolling_spring_stops() {
  Worst worst("type_c from rolling to rest: farthest point, resting point",
              "quadrature of the rolling spring", kRollingBar);
  const double mu = 0.05, eta = 0.3, u = 0.2;
  OnFloor set(0.8, mu, RollingModel::type_c);
  const double inertia = 1.4 * set.mass * kRadius * kRadius;
  const double k_n = 4.0 / 3.0 * set.Y_eff * std::sqrt(kRadius * set.overlap);
  const double k_r = 2.25 * k_n * mu * mu * kRadius * kRadius, limit = mu * kRadius * set.mass * kGravity;
  const double c_r = 2.0 * eta * std::sqrt(inertia * k_r), dt = 1e-7, end = 1.5 * 1.4 * u / (mu * kGravity);
  double angle = 0.0, spin = u / kRadius, spring = 0.0, farthest = 0.0;
  for (double t = 0.0; t < end; t += dt) {
    const double trial = spring - k_r * spin * dt;
    spring = std::clamp(trial, -limit, limit);
    spin += dt / inertia * (spring - (spring == trial ? c_r * spin : 0.0));
    angle += dt * spin;
    farthest = std::max(farthest, angle * kRadius);
  }
  Simulation simulation = set.with({u, 0.0, 0.0}, {0.0, u / kRadius, 0.0});
  double reached = 0.0;
  while (simulation.time() < end) {
    simulation.step();
    reached = std::max(reached, simulation.bodies().x[0]);
  }
  worst.add(farthest, reached);
  worst.add(angle * kRadius, simulation.bodies().x[0]);
  worst.add(0.0, simulation.bodies().velocity(0).norm(), u);
  return {worst.row()};
}

/// A sphere on an incline of angle θ: below tan θ = 3.5 μ it rolls with 5/7 g sin θ, above it slides with
/// g (sin θ − μ cos θ) and spins up with 2.5 μ g cos θ / R. The incline is a floor that is pulled from under
/// the sphere with g tan θ: seen from it, gravity is g/cos θ at θ from its normal.
Rows incline() {
  Worst worst(
      "sphere on an incline, tan θ 0.7, 1.75, 3.15, 3.85 and 10.5 μ (slips above 3.5): path, speed, spin",
      "rigid-body dynamics", kRollingBar);
  const double friction = 0.2, end = 0.2;
  for (const double part : {0.2, 0.5, 0.9, 1.1, 3.0}) {
    const double tangent = part * 3.5 * friction, pull = tangent * kGravity;
    Simulation simulation = OnFloor(friction, 0.0, RollingModel::type_a).with(Vec3::Zero(), Vec3::Zero());
    const Bodies& bodies = simulation.bodies();
    while (simulation.time() < end) {
      simulation.walls[0].velocity.x() = -pull * simulation.time();
      simulation.step();
    }
    const double t = simulation.time(), floor_speed = -pull * t, floor_path = -0.5 * pull * t * t;
    const bool rolls = part < 1.0;
    const double gain = rolls ? 5.0 / 7.0 * pull : pull - friction * kGravity;
    worst.add(gain * t, bodies.velocity(0).x() - floor_speed);
    worst.add(0.5 * gain * t * t, bodies.x[0] - floor_path);
    worst.add((rolls ? gain : 2.5 * friction * kGravity) * t / kRadius, bodies.angular_velocity(0).y());
  }
  return {worst.row()};
}

/// A clump of four spheres that stands flat cannot roll: it rests below tan θ = μ and slides above with
/// g (sin θ − μ cos θ). The incline is tilted over 0.2 s: pulled at once, the springs of the contacts would
/// swing to twice their load and slip below the friction angle. Speeds are compared over the 0.2 s after
/// that, in which the incline itself gains g tan θ × 0.2 s.
Row block_on_incline() {
  Worst worst("block of four spheres on an incline at 0.5, 0.9, 1.1 and 3 times tan θ = μ: gain of speed",
              "Coulomb", kRollingBar);
  const double friction = 0.4, tilting = 0.2, sliding = 0.2;
  std::vector<Sphere> feet;
  for (const double x : {-0.04, 0.04})
    for (const double y : {-0.04, 0.04}) feet.push_back({{x, y, 0.0}, kRadius});
  Clump block = test::summed_clump(feet);
  block.spheres = feet;  // in the frame as given, which is as good: the plane of the feet is the floor's
  for (const double part : {0.5, 0.9, 1.1, 3.0}) {
    const double pull = part * friction * kGravity;
    OnFloor set(friction, 0.0, RollingModel::type_a);
    set.scene.particles.shapes = {block};
    Simulation simulation = set.with(Vec3::Zero(), Vec3::Zero());
    const auto slip = [&] { return simulation.bodies().velocity(0).x() - simulation.walls[0].velocity.x(); };
    double before = 0.0;
    while (simulation.time() < tilting + sliding) {
      const double t = simulation.time();
      simulation.walls[0].velocity.x() = -pull * (t < tilting ? 0.5 * t * t / tilting : t - 0.5 * tilting);
      simulation.step();
      if (t < tilting) before = slip();
    }
    worst.add(std::max(pull - friction * kGravity, 0.0) * sliding, slip() - before, pull * sliding);
  }
  return worst.row();
}

}  // namespace

Rows sliding_and_rolling_rows() {
  Rows rows;
  for (const auto part :
       {slip_to_roll, stop_distance, rolling_spring_oscillates, rolling_spring_stops, incline}) {
    const Rows more = part();
    rows.insert(rows.end(), more.begin(), more.end());
  }
  rows.push_back(block_on_incline());
  return rows;
}

}  // namespace repose::verification
