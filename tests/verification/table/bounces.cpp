#include <array>

#include "engine/contact/law_parameters.hpp"
#include "reference/normal_impact.hpp"
#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr double kBounceBar = 1e-3;

/// A dropped sphere: time of the fall, and heights of its bounces r + (h − r) e^{2k}. The law of heights is
/// that of a contact without duration: gravity during the contact changes them by the contact's share of the
/// flight, 3e-4 here.
Rows falls_and_bounces() {
  Worst fall("free fall: time until it touches", "√(2 (h − r)/g)", kBounceBar);
  Worst bounce("bounces 1–3 of a dropped sphere: height over the floor", "r + (h − r) e^2k", kBounceBar);
  const double r = 0.02, h = 0.5, dt = 2e-7;
  for (const double e : {0.8, 0.9}) {
    const Scene scene = test::scene_of({sphere_clump(r)}, {2500.0, 1e11, 0.25}, {e, 0.0, 0.0});
    Simulation simulation(scene, dt);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, h};
    simulation.add(body);
    const Bodies& bodies = simulation.bodies();
    bool touched = false;
    double top = 0.0;
    for (int bounces = 0; bounces < 4;) {
      simulation.step();
      const bool touches = bodies.load[0].contacts > 0.0;
      if (touches && !touched) {
        if (bounces == 0) fall.add(std::sqrt(2.0 * (h - r) / kGravity), simulation.time());
        if (bounces > 0) bounce.add(r + (h - r) * std::pow(e, 2 * bounces), top);
        ++bounces;
        top = 0.0;
      }
      touched = touches;
      top = std::max(top, bodies.z[0]);
    }
  }
  return {fall.row(), bounce.row()};
}

/// Two unequal spheres squeezed between two walls: their paths against Runge–Kutta steps of the equations of
/// motion.
Rows squeezed_spheres() {
  const double r = 5e-3, density = 4000.0, e = 0.8;
  const Material material{density, 1e8, 0.3};
  const Scene scene = test::scene_of({sphere_clump(r), sphere_clump(0.8 * r)}, material, {e, 0.0, 0.0});
  // From the left wall at x = 0: sphere, smaller sphere, right wall; all three contacts pressed by 1 % of r
  // or more.
  const double length = 2.0 * r + 1.6 * r - 0.05 * r;
  std::array<double, 4> y{0.99 * r, length - 0.78 * r, 0.0, 0.0};
  const double end = 4e-3, dt = 1e-7;

  const auto contact = [&](double R_eff, double m_eff, double Y_eff) {
    return reference::NormalImpact{Y_eff, R_eff, m_eff, 2.0 * std::sqrt(5.0 / 6.0) * damping_ratio(e), false};
  };
  const double m_1 = density * sphere_clump(r).volume, m_2 = density * sphere_clump(0.8 * r).volume;
  const double Y = material.shear_modulus / (1.0 - material.poisson_ratio);  // Y*, of two alike
  const auto left = contact(r, m_1, Y), middle = contact(r * 0.8 / 1.8, m_1 * m_2 / (m_1 + m_2), Y),
             right = contact(0.8 * r, m_2, Y);
  const auto rate = [&](const std::array<double, 4>& s) {
    const double F_l = left.force(r - s[0], -s[2]), F_m = middle.force(1.8 * r - (s[1] - s[0]), s[2] - s[3]),
                 F_r = right.force(s[1] + 0.8 * r - length, s[3]);
    return std::array<double, 4>{s[2], s[3], (F_l - F_m) / m_1, (F_m - F_r) / m_2};
  };
  const auto moved = [](const std::array<double, 4>& s, const std::array<double, 4>& k, double step) {
    return std::array<double, 4>{s[0] + step * k[0], s[1] + step * k[1], s[2] + step * k[2],
                                 s[3] + step * k[3]};
  };

  Simulation simulation(scene, dt);
  simulation.walls = {test::side_wall(length, 1e6 * r), test::side_wall(0.0, 1e6 * r)};
  simulation.walls[1].kind = Wall::Kind::half_shell_minus;
  simulation.walls[1].x_offset = simulation.walls[1].radius;
  NewBody body;
  body.position = {y[0], 0.0, 0.0};
  simulation.add(body);
  body.shape = 1;
  body.position = {y[1], 0.0, 0.0};
  simulation.add(body);
  // Velocities of the leapfrog stand half a step before the positions.
  Worst worst("two spheres squeezed between walls: paths over the first swing",
              "Runge–Kutta of the equations", kBounceBar);
  const auto start = y;
  std::array<double, 2> low{y[0], y[1]}, high = low;
  struct Point {
    double theory, result;
    int sphere;
  };
  std::vector<Point> points;
  while (simulation.time() < end) {
    simulation.step();
    const auto k1 = rate(y), k2 = rate(moved(y, k1, 0.5 * dt)), k3 = rate(moved(y, k2, 0.5 * dt)),
               k4 = rate(moved(y, k3, dt));
    for (std::size_t k = 0; k < 4; ++k) y[k] += dt / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k]);
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], y[k]), high[k] = std::max(high[k], y[k]);
      if (simulation.steps() % 50 == 0)
        points.push_back({y[k] - start[k], simulation.bodies().x[k] - start[k], static_cast<int>(k)});
    }
  }
  for (const Point& p : points) {
    const auto k = static_cast<std::size_t>(p.sphere);
    worst.add(p.theory, p.result, high[k] - low[k]);
  }
  return {worst.row()};
}

}  // namespace

Rows bounce_rows() {
  Rows rows = falls_and_bounces();
  const Rows more = squeezed_spheres();
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace repose::verification
