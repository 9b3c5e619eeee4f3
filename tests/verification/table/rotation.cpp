#include "engine/dynamics/integrate.hpp"
#include "support/test_scene.hpp"
#include "verification/table/row.hpp"
#include "verification/table/tumbling_body.hpp"

namespace repose::verification {

namespace {

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
    integrate(bodies, {5e-5, RollingModel::type_c});
    if (k % 10 == 0) worst.add(E, energy(bodies));
  }
  worst.add(L.norm(), L.norm() + (momentum(bodies) - L).norm());
  return {worst.row()};
}

/// Clumps thrown at each other: momentum follows gravity alone, angular momentum stays.
Rows closed_cloud() {
  Worst worst("closed cloud of clumps: momentum and angular momentum", "conserved to rounding", 1e-12);
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
  long contacts = 0;
  for (int k = 0; k < 5000; ++k) {
    simulation.step();
    for (const char touches : simulation.touching_another()) contacts += touches;
  }
  const Sums after = sums();
  const Vec3 fallen(0.0, 0.0, -before.mass * kGravity * simulation.time());
  worst.add(0.0, (after.linear - before.linear - fallen).norm(), before.thrown);
  worst.add(0.0, (after.angular - before.angular).norm(), before.spun);
  if (contacts < 5000) worst.add(0.0, std::nan(""), 1.0);  // they met
  return {worst.row()};
}

}  // namespace

Rows rotation_rows() {
  Rows rows;
  for (const auto part : {middle_axis, closed_cloud}) {
    const Rows more = part();
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace repose::verification
