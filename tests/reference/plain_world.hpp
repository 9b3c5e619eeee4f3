#pragma once

#include <array>
#include <map>
#include <vector>

#include "engine/dynamics/simulation.hpp"
#include "reference/plain_contact.hpp"

namespace repose::reference {

/// Loads of all bodies, found the slow way: every sphere against every sphere of every other body and against
/// every wall, one contact at a time, with the history of each contact kept in a map under the bodies' own
/// numbers.
class PlainWorld {
 public:
  struct Load {
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    double rolling = 0.0;  ///< type_a: Σ μr |F_n| R_i
    double parts = 0.0;    ///< Σ PlainForces::parts: what rounding is to be compared with
    int contacts = 0;
  };
  using Key = std::array<int, 4>;  ///< body, sphere, body, sphere; walls: −1, wall

  PlainWorld(const ContactMaterial& pair, const ContactMaterial& wall) : pair_(pair), wall_(wall) {}

  /// Loads for the state in which a step begins; histories are brought to this step.
  std::vector<Load> loads(const Bodies& bodies, const std::vector<Wall>& walls, double dt) {
    collect(bodies);
    std::vector<Load> loads(bodies.count);
    std::map<Key, PlainMemory> kept;
    std::map<int, int> contacts;
    for (std::size_t a = 0; a < spheres_.size(); ++a) {
      for (std::size_t b = a + 1; b < spheres_.size(); ++b)
        if (spheres_[a].body != spheres_[b].body) pair(bodies, a, b, dt, loads, kept);
      for (std::size_t w = 0; w < walls.size(); ++w)
        if (walls[w].present) wall(bodies, a, walls[w], static_cast<int>(w), dt, loads, kept);
    }
    for (std::size_t i = 0; i < bodies.count; ++i) contacts[bodies.id[i]] = loads[i].contacts;
    memory_ = std::move(kept);
    contacts_ = std::move(contacts);
    return loads;
  }

  /// The contacts of a wall become another's where the spheres' centres (as of the last call) lie beyond x =
  /// 0.
  void hand_over(int from, int plus, int minus) {
    std::map<Key, PlainMemory> moved;
    for (const auto& [key, memory] : memory_) {
      Key to = key;
      if (key[2] == -1 && key[3] == from) to[3] = last_x_.at({key[0], key[1]}) > 0.0 ? plus : minus;
      moved[to] = memory;
    }
    memory_ = std::move(moved);
  }

  [[nodiscard]] std::size_t contacts() const { return memory_.size(); }
  [[nodiscard]] const std::map<Key, PlainMemory>& memory() const { return memory_; }

 private:
  struct Placed {
    Vec3 centre;
    double radius = 0.0;
    std::size_t body = 0;
    int sphere = 0;
  };

  void collect(const Bodies& bodies) {
    spheres_.clear();
    last_x_.clear();
    for (std::size_t i = 0; i < bodies.count; ++i) {
      const Mat3 turn = bodies.orientation(i).toRotationMatrix();
      int number = 0;
      for (const Sphere& s : bodies.spheres(i)) {
        spheres_.push_back({bodies.position(i) + bodies.scale[i] * (turn * s.centre),
                            bodies.scale[i] * s.radius, i, number});
        last_x_[{bodies.id[i], number}] = spheres_.back().centre.x();
        ++number;
      }
    }
  }

  [[nodiscard]] static PlainSide side(const Bodies& bodies, std::size_t i, const Vec3& point) {
    return {bodies.velocity(i), bodies.angular_velocity(i), point - bodies.position(i)};
  }
  [[nodiscard]] double softest(const Bodies& bodies, std::size_t i) const {
    const auto before = contacts_.find(bodies.id[i]);
    const int count = before == contacts_.end() ? 0 : before->second;
    return std::max(count, 1) * std::max({bodies.inverse_i1[i], bodies.inverse_i2[i], bodies.inverse_i3[i]});
  }
  /// Moment about the contact point, by the mean principal moment.
  [[nodiscard]] static double about(const Bodies& bodies, std::size_t i, const PlainSide& s) {
    const double mean =
        (1.0 / bodies.inverse_i1[i] + 1.0 / bodies.inverse_i2[i] + 1.0 / bodies.inverse_i3[i]) / 3.0;
    return mean + bodies.motion[i].mass * s.arm.squaredNorm();
  }
  static void add(Load& load, const PlainSide& s, const Vec3& force, const Vec3& torque, double rolling,
                  double parts) {
    load.force += force;
    load.torque += s.arm.cross(force) + torque;
    load.rolling += rolling * s.arm.norm();
    load.parts += parts;
    ++load.contacts;
  }
  [[nodiscard]] PlainMemory recall(const Key& key) const {
    const auto found = memory_.find(key);
    return found == memory_.end() ? PlainMemory{} : found->second;
  }

  void pair(const Bodies& bodies, std::size_t a, std::size_t b, double dt, std::vector<Load>& loads,
            std::map<Key, PlainMemory>& kept) {
    const Placed &p = spheres_[a], &q = spheres_[b];
    const double distance = (p.centre - q.centre).norm();
    PlainContact c;
    c.overlap = p.radius + q.radius - distance;
    if (!(c.overlap > 0.0)) return;
    c.n = (p.centre - q.centre) / distance;
    c.R_eff = 1.0 / (1.0 / p.radius + 1.0 / q.radius);
    c.m_eff = 1.0 / (1.0 / bodies.motion[p.body].mass + 1.0 / bodies.motion[q.body].mass);
    const Vec3 point = q.centre + (q.radius - 0.5 * c.overlap) * c.n;
    const PlainSide i = side(bodies, p.body, point), j = side(bodies, q.body, point);
    c.most_per_spin = 1.0 / (dt * (softest(bodies, p.body) + softest(bodies, q.body)));
    c.rolling_inertia = 1.0 / (1.0 / about(bodies, p.body, i) + 1.0 / about(bodies, q.body, j));
    const Key key{bodies.id[p.body], p.sphere, bodies.id[q.body], q.sphere};
    PlainMemory memory = recall(key);
    const PlainForces f = plain_contact(pair_, c, i, j, dt, memory);
    kept[key] = memory;
    const double rolling = pair_.model == RollingModel::type_a ? pair_.rolling * std::abs(f.F_n) : 0.0;
    add(loads[p.body], i, f.force, f.torque, rolling, f.parts);
    add(loads[q.body], j, -f.force, -f.torque, rolling, f.parts);
  }

  void wall(const Bodies& bodies, std::size_t a, const Wall& wall, int number, double dt,
            std::vector<Load>& loads, std::map<Key, PlainMemory>& kept) {
    const Placed& p = spheres_[a];
    const WallDistance seen = distance_to(wall, p.centre);
    PlainContact c;
    c.overlap = p.radius - seen.distance;
    if (!(c.overlap > 0.0)) return;
    c.n = seen.normal;
    c.R_eff = p.radius;
    c.m_eff = bodies.motion[p.body].mass;
    const PlainSide i = side(bodies, p.body, p.centre - (p.radius - 0.5 * c.overlap) * c.n);
    const PlainSide j{wall.velocity, Vec3::Zero(), Vec3::Zero()};
    c.most_per_spin = 1.0 / (dt * softest(bodies, p.body));
    c.rolling_inertia = about(bodies, p.body, i);
    const Key key{bodies.id[p.body], p.sphere, -1, number};
    PlainMemory memory = recall(key);
    const PlainForces f = plain_contact(wall_, c, i, j, dt, memory);
    kept[key] = memory;
    add(loads[p.body], i, f.force, f.torque,
        wall_.model == RollingModel::type_a ? wall_.rolling * std::abs(f.F_n) : 0.0, f.parts);
  }

  ContactMaterial pair_, wall_;
  std::vector<Placed> spheres_;
  std::map<Key, PlainMemory> memory_;
  std::map<int, int> contacts_;  ///< of each body at the last step
  std::map<std::array<int, 2>, double> last_x_;
};

/// The material of a scene's contacts as the plain law takes it.
inline ContactMaterial plain_material(const Scene& scene, const Material& other, const ContactParameters& p) {
  const auto elastic = [&](const Material& m) {
    return Elastic{scene.numerics.stiffness_scale * m.shear_modulus, m.poisson_ratio};
  };
  ContactMaterial result{elastic(scene.particles.material), elastic(other)};
  result.e = p.restitution;
  result.friction = p.static_friction;
  result.rolling = p.rolling_friction;
  result.rolling_damping = scene.contact.rolling_damping_ratio;
  result.model = scene.contact.rolling_model;
  result.history = scene.contact.tangential_history;
  result.damping = scene.contact.normal_damping;
  return result;
}

}  // namespace repose::reference
