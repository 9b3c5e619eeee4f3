#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

/// A clump of one sphere beside a lump, whose presence makes the engine follow orientations: the same path as
/// the sphere alone.
Rows one_sphere() {
  Worst worst("clump of one sphere: path against the sphere's", "the same body", 1e-9);
  RandomStream random(5, 1);
  const Clump lump = test::random_clump(random, 4, 5e-3);
  const auto path = [&](bool with_lump) {
    Simulation simulation(
        test::scene_of(with_lump ? std::vector{sphere_clump(4e-3), lump} : std::vector{sphere_clump(4e-3)},
                       test::kGlass, {0.7, 0.5, 0.1}, RollingModel::type_c),
        1e-5);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, 0.02};
    body.velocity = {0.3, 0.0, 0.0};
    body.angular_velocity = {10.0, -40.0, 20.0};
    simulation.add(body);
    for (int k = 0; k < 30000; ++k) simulation.step();
    return simulation.bodies().position(0);
  };
  const Vec3 sphere = path(false);
  worst.add(sphere.norm(), sphere.norm() + (path(true) - sphere).norm());
  return {worst.row()};
}

/// A flat clump of N spheres that falls flat on a plate touches with N springs at once: damping ratio √N β,
/// rebound exp(−π √N β/√(1 − N β²)).
Rows flat_clump() {
  Rows rows;
  for (const int count : {2, 3, 4}) {
    Worst worst("flat clump of " + std::to_string(count) + " spheres on a plate, e 0.5, 0.7, 0.9: rebound",
                "N springs in parallel", 1e-3);
    std::vector<Sphere> spheres;
    for (int k = 0; k < count; ++k)
      spheres.push_back(
          {5e-3 * Vec3(std::cos(2.0 * kPi * k / count), std::sin(2.0 * kPi * k / count), 0.0), 4e-3});
    Clump clump = test::summed_clump(spheres);
    // The same frame as given: the plane of the spheres is the floor's.
    for (int k = 0; k < count; ++k)
      clump.spheres[static_cast<std::size_t>(k)] = spheres[static_cast<std::size_t>(k)];
    for (const double e : {0.5, 0.7, 0.9}) {
      const double log_e = std::log(e), ratio = -log_e / std::hypot(log_e, kPi) * std::sqrt(count);
      const Material material{2500.0, 1e9, 0.25};
      Simulation simulation(test::scene_of({clump}, material, {e, 0.0, 0.0}), 1e-8);
      simulation.walls = {test::floor_wall()};
      NewBody body;
      body.position = {0.0, 0.0, 4.0001e-3};
      body.velocity = {0.0, 0.0, -2.0};
      simulation.add(body);
      const Bodies& bodies = simulation.bodies();
      bool touched = false;
      while (!(touched && bodies.load[0].contacts == 0.0)) {
        simulation.step();
        touched = touched || bodies.load[0].contacts > 0.0;
      }
      worst.add(std::exp(-kPi * ratio / std::sqrt(1.0 - ratio * ratio)), bodies.velocity(0).z() / 2.0);
    }
    rows.push_back(worst.row());
  }
  return rows;
}

}  // namespace

Rows clump_rows() {
  Rows rows = one_sphere();
  const Rows more = flat_clump();
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace repose::verification
