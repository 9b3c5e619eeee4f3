#pragma once

#include <limits>
#include <optional>

#include "support/test_scene.hpp"

namespace repose::verification {

/// Y and ν as the literature gives them; the engine takes G = Y / (2 (1 + ν)).
inline Material elastic_material(double young, double poisson, double density) {
  return {density, young / (2.0 * (1.0 + poisson)), poisson};
}
/// A wall that does not yield.
inline Material rigid() { return {1.0, 1e30, 0.3}; }

/// A body flies along +x at a flat wall or at a second body; its tangential motion is along +y and its spin
/// about z. Gravity is taken out: the wall falls with the bodies, and what they have gained by falling is
/// subtracted.
struct Impact {
  Clump body = sphere_clump(1e-2);
  Material material;
  Material wall = rigid();
  ContactParameters contact;
  NormalDamping damping = NormalDamping::with_tail;
  TangentialHistory history = TangentialHistory::force;
  Vec3 velocity = Vec3::UnitX();
  Vec3 spin = Vec3::Zero();
  std::optional<Clump> other;  ///< instead of the wall
  Vec3 other_velocity = Vec3::Zero();
  Vec3 other_spin = Vec3::Zero();
  int steps_per_contact = 4000;

  struct Result {
    double F_max = 0.0;
    double overlap_max = 0.0;
    double duration = 0.0;
    Vec3 velocity, spin, other_velocity, other_spin;
  };

  [[nodiscard]] double R_eff() const {
    const double r = body.spheres.front().radius;
    return other ? 1.0 / (1.0 / r + 1.0 / other->spheres.front().radius) : r;
  }
  [[nodiscard]] double m_eff() const {
    const double m = material.density * body.volume;
    return other ? 1.0 / (1.0 / m + 1.0 / (material.density * other->volume)) : m;
  }
  [[nodiscard]] double Y_eff() const {
    const auto compliance = [](const Material& m) {
      return (1.0 - m.poisson_ratio) / (2.0 * m.shear_modulus);  // (1 − ν²)/Y
    };
    return 1.0 / (compliance(material) + compliance(other ? material : wall));
  }
  [[nodiscard]] double elastic_duration() const {
    const double v = velocity.x() - other_velocity.x();
    return 2.868 * std::pow(m_eff() * m_eff() / (R_eff() * Y_eff() * Y_eff() * v), 0.2);
  }
  [[nodiscard]] Result run() const {
    Scene scene = test::scene_of(other ? std::vector{body, *other} : std::vector{body}, material, contact);
    scene.walls = wall;
    scene.contact.normal_damping = damping;
    scene.contact.tangential_history = history;
    const double dt = elastic_duration() / steps_per_contact;
    Simulation simulation(scene, dt);
    const double r = body.spheres.front().radius;
    const double gap = 0.5 * (velocity.x() - other_velocity.x()) * dt;
    NewBody first;
    first.velocity = velocity;
    first.angular_velocity = spin;
    simulation.add(first);
    const double reach = r + gap + (other ? other->spheres.front().radius : 0.0);
    if (other) {
      NewBody second;
      second.shape = 1;
      second.position = {reach, 0.0, 0.0};
      second.velocity = other_velocity;
      second.angular_velocity = other_spin;
      simulation.add(second);
    } else {
      simulation.walls = {test::side_wall(reach, 1e6 * r)};
    }
    return follow(simulation, reach - gap, dt);
  }

 private:
  [[nodiscard]] Result follow(Simulation& simulation, double touching, double dt) const {
    const Bodies& bodies = simulation.bodies();
    Result result;
    bool touched = false;
    for (long step = 0; step < 400L * steps_per_contact; ++step) {
      const double apart = other ? (bodies.position(1) - bodies.position(0)).norm()
                                 : simulation.walls[0].x_offset + simulation.walls[0].radius - bodies.x[0];
      result.overlap_max = std::max(result.overlap_max, touching - apart);
      for (Wall& w : simulation.walls) w.velocity.z() = -kGravity * simulation.time();
      simulation.step();
      const bool touches = bodies.load[0].contacts > 0.0;
      if (touched && !touches) break;
      touched = touched || touches;
      if (!touches) continue;
      result.duration += dt;
      result.F_max = std::max(result.F_max, std::abs(bodies.load[0].force[0]));
    }
    const Vec3 fallen(0.0, 0.0, kGravity * simulation.time());
    result.velocity = bodies.velocity(0) + fallen;
    result.spin = bodies.angular_velocity(0);
    if (other) {
      result.other_velocity = bodies.velocity(1) + fallen;
      result.other_spin = bodies.angular_velocity(1);
    }
    return result;
  }
};

}  // namespace repose::verification
