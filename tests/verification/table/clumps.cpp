#include <array>

#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

/// Two spheres that are clumps of one: beside a lump, whose presence makes the engine follow orientations,
/// they fall, hit each other and the floor, roll and stop just as spheres alone.
Rows one_sphere() {
  Worst worst(
      "clumps of one sphere, hitting each other and the floor: path, speed and spin against the spheres'",
      "the same bodies", 1e-9);
  RandomStream random(5, 1);
  const Clump lump = test::random_clump(random, 4, 5e-3);
  const auto end = [&](bool with_lump) {
    // A clump of one sphere by the sum of its spheres' masses, or the sphere itself.
    const Clump ball = with_lump ? test::summed_clump({{Vec3::Zero(), 4e-3}}) : sphere_clump(4e-3);
    Simulation simulation(test::scene_of(with_lump ? std::vector{ball, lump} : std::vector{ball},
                                         test::kGlass, {0.7, 0.5, 0.1}, RollingModel::type_c),
                          1e-5);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, 0.02};
    body.velocity = {0.3, 0.0, 0.0};
    body.angular_velocity = {10.0, -40.0, 20.0};
    simulation.add(body);
    body.position = {0.012, 0.001, 0.02};
    body.velocity = {-0.3, 0.0, 0.0};
    simulation.add(body);
    bool hit = false;
    for (int k = 0; k < 30000; ++k) {
      simulation.step();
      hit = hit || simulation.touching_another()[0] != 0;
    }
    std::vector<Vec3> state;
    for (std::size_t i = 0; i < 2; ++i) {
      state.push_back(simulation.bodies().position(i));
      state.push_back(simulation.bodies().velocity(i));
      state.push_back(simulation.bodies().angular_velocity(i));
    }
    if (!hit) state.front().setConstant(std::nan(""));  // a test of nothing is a missed one
    return state;
  };
  const std::vector<Vec3> spheres = end(false), clumps = end(true);
  const std::array<double, 3> scales{0.02, 0.3, 40.0};  // of the start: height, speed, spin
  for (std::size_t k = 0; k < spheres.size(); ++k)
    worst.add(spheres[k].norm(), spheres[k].norm() + (clumps[k] - spheres[k]).norm(), scales[k % 3]);
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
      Simulation simulation(test::scene_of({clump}, material, {e, 0.0, 0.0}), 5e-9);
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
