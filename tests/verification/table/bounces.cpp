#include <array>

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

/// Two unequal spheres stacked between a floor and a ceiling: their paths against Runge–Kutta steps of the
/// equations of motion. Heights are along x: floor and ceiling are flat side walls that are pulled along +x
/// with g, so that seen from them gravity presses the stack on the floor; the common fall along −z moves
/// nothing against anything, for there is no friction.
class Stack {
 public:
  Row run() const {
    const double end = 1.5e-3, dt = 5e-8;
    Simulation simulation(
        test::scene_of({sphere_clump(kLower), sphere_clump(kUpper)}, material_, {kE, 0.0, 0.0}), dt);
    simulation.walls = {test::side_wall(kHeight, 1e6 * kLower), test::side_wall(0.0, 1e6 * kLower)};
    simulation.walls[1].kind = Wall::Kind::half_shell_minus;
    simulation.walls[1].x_offset = simulation.walls[1].radius;
    State y{kLower - 0.01 * kLower, kHeight - 0.98 * kUpper, 0.0, 0.0};
    const State start = y, pull = rate(y);
    for (int k = 0; k < 2; ++k) {
      NewBody body;
      body.shape = k;
      body.position = {y[at(k)], 0.0, 0.0};
      body.velocity.x() = -0.5 * dt * (pull[at(2 + k)] + kGravity);  // leapfrog: half a step before
      simulation.add(body);
    }
    std::array<double, 2> low{y[0], y[1]}, high = low;
    std::vector<std::array<double, 4>> points;  // theory and result of both
    while (simulation.time() < end) {
      for (Wall& wall : simulation.walls) wall.velocity.x() = kGravity * (simulation.time() + 0.5 * dt);
      simulation.step();
      y = advanced(y, dt);
      const double risen = 0.5 * kGravity * simulation.time() * simulation.time();
      for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], y[k]), high[k] = std::max(high[k], y[k]);
      if (simulation.steps() % 50 == 0)
        points.push_back({y[0] - start[0], simulation.bodies().x[0] - risen - start[0], y[1] - start[1],
                          simulation.bodies().x[1] - risen - start[1]});
    }
    Worst worst("two stacked spheres between floor and ceiling: their paths", "Runge–Kutta of the equations",
                kBounceBar);
    for (const auto& p : points) {
      worst.add(p[0], p[1], high[0] - low[0]);
      worst.add(p[2], p[3], high[1] - low[1]);
    }
    return worst.row();
  }

 private:
  using State = std::array<double, 4>;  ///< heights, speeds
  static constexpr double kLower = 5e-3, kUpper = 4e-3, kE = 0.8;
  static constexpr double kHeight = 2.0 * (kLower + kUpper) - 0.05 * kLower;

  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  [[nodiscard]] State rate(const State& s) const {
    const double F_floor = floor_.force(kLower - s[0], -s[2]),
                 F_pair = pair_.force(kLower + kUpper - (s[1] - s[0]), s[2] - s[3]),
                 F_ceiling = ceiling_.force(s[1] + kUpper - kHeight, s[3]);
    return {s[2], s[3], (F_floor - F_pair) / m_lower_ - kGravity, (F_pair - F_ceiling) / m_upper_ - kGravity};
  }
  [[nodiscard]] State advanced(const State& s, double dt) const {
    const auto moved = [](const State& from, const State& slope, double step) {
      State to = from;
      for (std::size_t k = 0; k < 4; ++k) to[k] += step * slope[k];
      return to;
    };
    const State k1 = rate(s), k2 = rate(moved(s, k1, 0.5 * dt)), k3 = rate(moved(s, k2, 0.5 * dt)),
                k4 = rate(moved(s, k3, dt));
    State next = s;
    for (std::size_t k = 0; k < 4; ++k) next[k] += dt / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k]);
    return next;
  }

  Material material_{4000.0, 1e8, 0.3};
  double m_lower_ = material_.density * sphere_clump(kLower).volume;
  double m_upper_ = material_.density * sphere_clump(kUpper).volume;
  double Y_ = material_.shear_modulus / (1.0 - material_.poisson_ratio);  ///< Y*, of two alike
  double gamma_ = reference::gamma_for_rebound(kE, false);
  reference::NormalImpact floor_{Y_, kLower, m_lower_, gamma_, false};
  reference::NormalImpact pair_{Y_, kLower* kUpper / (kLower + kUpper),
                                m_lower_* m_upper_ / (m_lower_ + m_upper_), gamma_, false};
  reference::NormalImpact ceiling_{Y_, kUpper, m_upper_, gamma_, false};
};

}  // namespace

Rows bounce_rows() {
  Rows rows = falls_and_bounces();
  rows.push_back(Stack().run());
  return rows;
}

}  // namespace repose::verification
