#include "engine/dynamics/integrate.hpp"
#include "reference/free_rotation.hpp"
#include "reference/normal_impact.hpp"
#include "support/test_scene.hpp"
#include "verification/table/plot.hpp"
#include "verification/table/row.hpp"
#include "verification/table/tumbling_body.hpp"

namespace repose::verification {

namespace {

/// One way to integrate, with what its theory says of its order.
struct Way {
  const char* name;
  Integrator integrator;
  double velocity_offset;  ///< instant of the velocities against the positions', in steps
  double order_elastic, order_damped;
  int finer = 1;  ///< by which its steps are divided, to where the leading error is all that is left
};

/// Symplectic Euler, read as leapfrog, is of second order where forces depend on positions alone; damping
/// acts with the velocity of half a step before, which costs one order. Velocity Verlet carries the
/// velocities on.
const std::vector<Way>& ways() {
  static const std::vector<Way> list{{"symplectic Euler", Integrator::symplectic_euler, -0.5, 2.0, 1.0},
                                     {"velocity Verlet", Integrator::velocity_verlet, -0.5, 2.0, 2.0},
                                     {"explicit Euler", Integrator::explicit_euler, 0.0, 1.0, 1.0, 32}};
  return list;
}

/// Errors at one instant over steps that halve.
struct Convergence {
  std::vector<double> steps;   ///< Δt, in the unit that the plot names
  std::vector<double> errors;  ///< in the unit that the plot names
  [[nodiscard]] double order() const {
    return std::log(errors.front() / errors.back()) / std::log(steps.front() / steps.back());
  }
};

/// A sphere that swings on the floor without leaving it: smooth forces. Let go 30 % of its resting overlap
/// below its resting place; where is it after 2.3 periods? The theory is fourth-order Runge–Kutta of
///   m δ'' = m g − F(δ, δ').
class Swing {
 public:
  explicit Swing(double e) : e_(e) {
    const double stiffness = 2.0 * Y_ * std::sqrt(kRadius * resting());
    period_ = 2.0 * kPi * std::sqrt(mass() / stiffness);
    exact_ = by_runge_kutta(20000);
  }
  [[nodiscard]] Convergence converge(const Way& way) const {
    Convergence result;
    for (const int coarse : {100, 200, 400, 800, 1600}) {
      const int steps = way.finer * coarse;
      result.steps.push_back(kPeriods / steps);
      result.errors.push_back(std::abs(by_engine(way, steps) - exact_) / (0.3 * resting()));
    }
    return result;
  }

 private:
  static constexpr double kRadius = 0.01, kPeriods = 2.3;

  [[nodiscard]] double mass() const { return material_.density * sphere_clump(kRadius).volume; }
  [[nodiscard]] double resting() const {
    return std::pow(0.75 * mass() * kGravity / (Y_ * std::sqrt(kRadius)), 2.0 / 3.0);
  }
  /// Overlap at the end.
  [[nodiscard]] double by_runge_kutta(int steps) const {
    const reference::NormalImpact contact{Y_, kRadius, mass(),
                                          e_ == 1.0 ? 0.0 : reference::gamma_for_rebound(e_, false), false};
    const double dt = kPeriods * period_ / steps;
    double x = 1.3 * resting(), u = 0.0;
    const auto gain = [&](double overlap, double closing) {
      return kGravity - contact.force(overlap, closing) / mass();
    };
    for (int k = 0; k < steps; ++k) {
      const double u1 = u, a1 = gain(x, u1), u2 = u + 0.5 * dt * a1, a2 = gain(x + 0.5 * dt * u1, u2),
                   u3 = u + 0.5 * dt * a2, a3 = gain(x + 0.5 * dt * u2, u3), u4 = u + dt * a3,
                   a4 = gain(x + dt * u3, u4);
      x += dt / 6.0 * (u1 + 2.0 * (u2 + u3) + u4);
      u += dt / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    }
    return x;
  }
  [[nodiscard]] double by_engine(const Way& way, int steps) const {
    const double dt = kPeriods * period_ / steps, overlap = 1.3 * resting();
    Scene scene = test::scene_of({sphere_clump(kRadius)}, material_, {e_, 0.0, 0.0});
    scene.numerics.integrator = way.integrator;
    Simulation simulation(scene, dt);
    simulation.walls = {test::floor_wall()};
    NewBody body;
    body.position = {0.0, 0.0, kRadius - overlap};
    const double gain = 4.0 / 3.0 * Y_ * std::sqrt(kRadius) * std::pow(overlap, 1.5) / mass() - kGravity;
    body.velocity = {0.0, 0.0, way.velocity_offset * dt * gain};
    simulation.add(body);
    for (int k = 0; k < steps; ++k) simulation.step();
    return kRadius - simulation.bodies().z[0];
  }

  double e_, period_ = 0.0, exact_ = 0.0;
  Material material_{2500.0, 1e7, 0.25};
  double Y_ = material_.shear_modulus / (1.0 - material_.poisson_ratio);
};

/// The rotation's integrator, which all ways share, on a body that tumbles about its middle axis.
Convergence rotation() {
  Bodies bodies = tumbling_body();
  const double end = 0.4;
  const Vec3 inertia(1.0 / bodies.inverse_i1[0], 1.0 / bodies.inverse_i2[0], 1.0 / bodies.inverse_i3[0]);
  const Quat exact = reference::free_rotation(inertia, {bodies.lx[0], bodies.ly[0], bodies.lz[0]},
                                              bodies.orientation(0), end, 20000);
  Convergence result;
  for (const int steps : {500, 1000, 2000, 4000}) {
    Bodies body = tumbling_body();
    for (int k = 0; k < steps; ++k) integrate(body, {end / steps, RollingModel::type_c});
    result.steps.push_back(end / steps);
    result.errors.push_back(body.orientation(0).angularDistance(exact));
  }
  return result;
}

Row order_row(const std::string& test, double theory, const Convergence& convergence) {
  Worst worst(test, "slope of the error over Δt", 0.1);
  worst.add(theory, convergence.order(), 1.0);
  return worst.row();
}

/// The errors and a line of the slope that theory says through the last of them.
void add_series(Plot& plot, const std::string& name, double order, const Convergence& convergence) {
  char measured[32];
  std::snprintf(measured, sizeof measured, "%.2f", convergence.order());
  plot.series.push_back(
      {name + ": slope " + measured, Series::Look::points, convergence.steps, convergence.errors});
  Series theory{
      "order " + std::to_string(static_cast<int>(order)), Series::Look::dashes, convergence.steps, {}};
  for (const double step : convergence.steps)
    theory.y.push_back(convergence.errors.back() * std::pow(step / convergence.steps.back(), order));
  plot.series.push_back(theory);
}

}  // namespace

Rows integrator_rows() {
  Rows rows{order_row("order of the rotation's integrator", 2.0, rotation())};
  const Swing elastic(1.0), damped(0.5);
  for (const Way& way : ways()) {
    const std::string order = std::string("order of the ") + way.name;
    rows.push_back(
        order_row(order + " on a smooth elastic contact", way.order_elastic, elastic.converge(way)));
    rows.push_back(order_row(order + " on a smooth damped contact", way.order_damped, damped.converge(way)));
  }
  return rows;
}

std::vector<Plot> order_plots() {
  Plot contact{"order_contact",
               "Integrators on a smooth contact: error after 2.3 periods",
               "step Δt / period [-]",
               "error / amplitude [-]",
               true,
               {}};
  const Swing elastic(1.0), damped(0.5);
  for (const Way& way : ways()) {
    add_series(contact, std::string(way.name) + ", elastic", way.order_elastic, elastic.converge(way));
    add_series(contact, std::string(way.name) + ", e = 0.5", way.order_damped, damped.converge(way));
  }
  Plot turning{"order_rotation",
               "Free rotation about the middle axis: error after 0.4 s",
               "step Δt [s]",
               "error of the orientation [rad]",
               true,
               {}};
  add_series(turning, "rotation", 2.0, rotation());
  return {contact, turning};
}

}  // namespace repose::verification
