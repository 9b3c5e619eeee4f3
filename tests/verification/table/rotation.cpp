#include "engine/dynamics/integrate.hpp"
#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

Bodies tumbling_body() {
  Clump clump;
  clump.name = "body";
  clump.spheres = {{Vec3(1e-3, 0.0, 0.0), 2e-3}};
  clump.volume = 1e-7;
  clump.inertia = {1e-12, 2e-12, 2.8e-12};
  Bodies bodies(std::vector{clump}, 1000.0);
  NewBody body;
  body.angular_velocity = {0.01, 20.0, 0.01};
  bodies.add(body);
  return bodies;
}
Vec3 momentum(const Bodies& b) { return {b.lx[0], b.ly[0], b.lz[0]}; }
double energy(const Bodies& b) { return 0.5 * momentum(b).dot(b.angular_velocity(0)); }

/// Free rotation about the middle axis, 1e5 steps of 50 µs: it tumbles over again and again.
Rows middle_axis() {
  Worst worst("free rotation about the middle axis, 1e5 steps: drift of energy and angular momentum",
              "both constant", 1e-6);
  Bodies bodies = tumbling_body();
  const double E = energy(bodies);
  const Vec3 L = momentum(bodies);
  for (int k = 0; k < 100000; ++k) {
    integrate(bodies, 5e-5, false);
    if (k % 10 == 0) worst.add(E, energy(bodies));
  }
  worst.add(L.norm(), L.norm() + (momentum(bodies) - L).norm());
  return {worst.row()};
}

double order_of(const std::vector<double>& errors) {  // of steps that halve each time
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

Row order_row(const char* test, double theory, const std::vector<double>& errors) {
  Worst worst(test, "slope of the error over Δt", 0.1);
  worst.add(theory, order_of(errors), 1.0);
  return worst.row();
}

Rows order_of_rotation() {
  const auto end = [](double dt) {
    Bodies bodies = tumbling_body();
    const auto steps = std::lround(0.4 / dt);
    for (long k = 0; k < steps; ++k) integrate(bodies, dt, false);
    return bodies.orientation(0);
  };
  const Quat exact = end(1e-5);
  std::vector<double> errors;
  for (const double dt : {8e-4, 4e-4, 2e-4}) errors.push_back(end(dt).angularDistance(exact));
  return {order_row("order of the rotation's integrator", 2.0, errors)};
}

/// A sphere that swings on the floor without leaving it: smooth forces. Second order where they depend on
/// positions alone; damping acts with the velocity of half a step before, which costs one order.
Rows order_of_translation() {
  const double r = 0.01;
  const Material material{2500.0, 1e7, 0.25};
  const double m = material.density * sphere_clump(r).volume;
  const double Y = material.shear_modulus / (1.0 - material.poisson_ratio);
  const double rest = std::pow(0.75 * m * kGravity / (Y * std::sqrt(r)), 2.0 / 3.0);
  const double period = 2.0 * kPi * std::sqrt(m / (2.0 * Y * std::sqrt(r * rest)));
  const auto end = [&](double e, int steps) {
    const double dt = 2.3 * period / steps;
    Simulation simulation(test::scene_of({sphere_clump(r)}, material, {e, 0.0, 0.0}), dt);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    const double overlap = 1.3 * rest;
    body.position = {0.0, 0.0, r - overlap};
    const double gain = 4.0 / 3.0 * Y * std::sqrt(r) * std::pow(overlap, 1.5) / m - kGravity;
    body.velocity = {0.0, 0.0, -0.5 * dt * gain};  // leapfrog: half a step before
    simulation.add(body);
    for (int k = 0; k < steps; ++k) simulation.step();
    return simulation.bodies().z[0];
  };
  Rows rows;
  for (const double e : {1.0, 0.5}) {
    const double exact = end(e, 204800);
    std::vector<double> errors;
    for (const int steps : {100, 200, 400, 800}) errors.push_back(std::abs(end(e, steps) - exact));
    rows.push_back(order_row(e == 1.0 ? "order of the leapfrog on a smooth elastic contact"
                                      : "order of the leapfrog on a smooth damped contact",
                             e == 1.0 ? 2.0 : 1.0, errors));
  }
  return rows;
}

/// Clumps thrown at each other: momentum follows gravity alone, angular momentum stays.
Rows closed_cloud() {
  Worst worst("closed cloud of clumps: momentum and angular momentum", "conserved to rounding", 1e-10);
  RandomStream random(7, 1);
  std::vector<Clump> shapes;
  for (int k = 2; k <= 5; ++k) shapes.push_back(test::random_clump(random, k, 5e-3));
  const double dt = 1e-5;
  Simulation simulation(test::scene_of(shapes, test::kGlass, {0.6, 0.5, 0.2}, RollingModel::type_c), dt);
  for (int k = 0; k < 48; ++k) {
    NewBody body;
    body.shape = k % 4;
    body.position = 0.014 * Vec3(k % 4, (k / 4) % 4, k / 16);
    body.orientation = random.rotation();
    body.velocity = -20.0 * (body.position - Vec3(0.02, 0.02, 0.015));
    body.angular_velocity = 50.0 * Vec3(random.normal(), random.normal(), random.normal());
    simulation.add(body);
  }
  const Bodies& bodies = simulation.bodies();
  struct Sums {
    double mass = 0.0, thrown = 0.0, spun = 0.0;
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  };
  const auto sums = [&bodies] {
    Sums s;
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < bodies.count; ++i) {
      s.mass += bodies.motion[i].mass;
      centre += bodies.motion[i].mass * bodies.position(i);
      s.linear += bodies.motion[i].mass * bodies.velocity(i);
      s.thrown += bodies.motion[i].mass * bodies.velocity(i).norm();
    }
    centre /= s.mass;
    for (std::size_t i = 0; i < bodies.count; ++i) {
      const Vec3 own(bodies.lx[i], bodies.ly[i], bodies.lz[i]);
      const Vec3 orbit =
          bodies.motion[i].mass * (bodies.position(i) - centre).cross(bodies.velocity(i) - s.linear / s.mass);
      s.angular += own + orbit;
      s.spun += own.norm() + orbit.norm();
    }
    return s;
  };
  const Sums before = sums();
  for (int k = 0; k < 5000; ++k) simulation.step();
  const Sums after = sums();
  const Vec3 fallen(0.0, 0.0, -before.mass * kGravity * simulation.time());
  worst.add(0.0, (after.linear - before.linear - fallen).norm(), before.thrown);
  worst.add(0.0, (after.angular - before.angular).norm(), before.spun);
  return {worst.row()};
}

}  // namespace

Rows rotation_rows() {
  Rows rows;
  for (const auto part : {middle_axis, order_of_rotation, order_of_translation, closed_cloud}) {
    const Rows more = part();
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace repose::verification
