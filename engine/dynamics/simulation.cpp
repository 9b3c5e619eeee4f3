#include "engine/dynamics/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/integrate.hpp"

namespace repose {

namespace {

/// Skins: a part of the mean particle's diameter, and some steps of a body that has fallen through the
/// cylinder, since one fast body is enough to list anew. A larger skin lists more candidates that never
/// touch, a smaller one lists more often; measured in tools/bench/NOTES.md.
ContactList::Skins skins_of(const Scene& scene, double dt) {
  const Particles& particles = scene.particles;
  double volume = 0.0;
  for (const SizeClass& size : particles.size_classes)
    volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  if (particles.size_classes.empty())
    for (const Clump& shape : particles.shapes)
      volume += shape.volume / static_cast<double>(particles.shapes.size());
  const double diameter = std::cbrt(6.0 * volume / kPi);
  const double fall = std::sqrt(2.0 * kGravity * scene.test.cylinder_height) * dt;
  return {0.3 * diameter + 7.0 * fall, 0.1 * diameter + 3.0 * fall};
}

ForceStep laws_of(const Scene& scene, double dt) {
  const double stiffness = scene.numerics.stiffness_scale;
  const auto side = [stiffness](const Material& material) {
    return ElasticSide{stiffness * material.shear_modulus, material.poisson_ratio};
  };
  const auto law = [&](const Material& other, const ContactParameters& p) {
    LawParameters parameters = law_parameters(
        side(scene.particles.material), side(other), p.restitution, p.static_friction, p.rolling_friction,
        scene.contact.rolling_damping_ratio, scene.contact.normal_damping, scene.contact.tangential_history);
    parameters.torque_limited = scene.contact.rolling_torque == RollingTorque::limited;
    return parameters;
  };
  const Integrator integrator = scene.numerics.integrator;
  return {.pair_law = law(scene.particles.material, scene.contact.particle_particle),
          .wall_law = law(scene.walls, scene.contact.particle_wall),
          .dt = dt,
          .leads = integrator == Integrator::velocity_verlet,
          .lag = integrator == Integrator::symplectic_euler ? 0.5 * dt : 0.0};
}

}  // namespace

Simulation::Simulation(const Scene& scene, double dt, std::shared_ptr<Crew> crew, std::size_t section_bodies)
    : dt_(dt),
      rolling_model_(scene.contact.rolling_model),
      motion_step_{dt, rolling_model_, scene.numerics.integrator, scene.contact.rolling_torque},
      force_step_(laws_of(scene, dt)),
      kernels_(force_kernels(scene.contact.rolling_model, scene.numerics.arithmetic)),
      bodies_(scene.particles.shapes, scene.particles.material.density),
      contacts_(bodies_.shapes, skins_of(scene, dt), dt, has_rolling_spring(rolling_model_), section_bodies),
      crew_(crew ? std::move(crew) : std::make_shared<Crew>()) {}

/// Members of the crew meet between phases: contacts need the spheres of all, and a body's motion the loads
/// that others have for it.
bool Simulation::step() {
  const auto members = static_cast<std::size_t>(crew_->admit());
  if (!contacts_.update(bodies_, walls, *crew_)) return false;
  if (members != shares_.size() ||
      contacts_.changes() != dealt_) {  // else what a core has in its cache stays
    dealt_ = contacts_.changes();
    shares_.resize(members);
    deal_out(contacts_.sections, tallies_, shares_);
    tallies_.resize(contacts_.sections.size());
  }
  const auto share = [this](int k) -> Share& { return shares_[static_cast<std::size_t>(k)]; };

  crew_->share([&](int k) { place_spheres(share(k)); });
  crew_->share([&](int k) {
    const RowTimer timer(share(k).pairs);
    pair_forces(share(k));
  });
  crew_->share([&](int k) {
    const RowTimer timer(share(k).motion);
    for (const Share& from : shares_) take_loads(share(k), from);
    move(share(k));
  });

  book_tallies();
  for (Wall& wall : walls) wall.advance(dt_);
  ++steps_;
  return true;
}

/// Of a share that is all there is, each section's spheres are placed right before its contacts, which are
/// with bodies of smaller numbers: they are still near in the cache.
void Simulation::place_spheres(const Share& share) {
  if (shares_.size() == 1) return;
  for (std::size_t s = share.pairs.first; s < share.pairs.last; ++s) place_spheres(contacts_.sections[s]);
}

void Simulation::place_spheres(const Section& section) {
  contacts_.place_spheres(bodies_, section);
  std::fill(bodies_.load.begin() + static_cast<std::ptrdiff_t>(section.first),
            bodies_.load.begin() + static_cast<std::ptrdiff_t>(section.last), BodyLoad{});
}

void Simulation::pair_forces(Share& share) {
  if (share.pairs.empty()) return share.beyond.start(0);
  share.beyond.start(NearList::kLine *
                     static_cast<std::int32_t>(contacts_.sections[share.pairs.first].first));
  for (std::size_t s = share.pairs.first; s < share.pairs.last; ++s) {
    Section& section = contacts_.sections[s];
    if (shares_.size() == 1) place_spheres(section);
    tallies_[s].work = kernels_.pairs(force_step_, bodies_, contacts_.placed, section.near_pairs,
                                      share.touching, share.beyond);
    tallies_[s].pairs_touching = share.touching.count;
  }
}

/// What a share's contacts put on bodies beyond its own that this one moves.
void Simulation::take_loads(const Share& share, const Share& from) {
  if (share.motion.empty()) return;
  const auto& sections = contacts_.sections;
  const auto begin = NearList::kLine * static_cast<std::int32_t>(sections[share.motion.first].first),
             end = NearList::kLine * static_cast<std::int32_t>(sections[share.motion.last - 1].last);
  for (std::size_t row = 0; row < from.beyond.body.size(); ++row) {
    const std::int32_t body = from.beyond.body[row];
    if (begin <= body && body < end) bodies_.load_at(body) += from.beyond.load[row];
  }
}

void Simulation::move(Share& share) {
  for (std::size_t s = share.motion.first; s < share.motion.last; ++s) {
    Section& section = contacts_.sections[s];
    tallies_[s].work += kernels_.walls(force_step_, bodies_, contacts_.placed, section.near_walls, walls,
                                       share.touching_walls);
    tallies_[s].walls_touching = share.touching_walls.count;
    tallies_[s].rolling_loss = integrate(bodies_, motion_step_, section.first, section.last);
  }
}

/// Section by section, so that sums do not depend on the shares.
void Simulation::book_tallies() {
  ContactWork work;
  for (const SectionTally& tally : tallies_) {
    work += tally.work;
    booked_.rolling_resistance += tally.rolling_loss;
  }
  book(work);
}

void Simulation::book(const ContactWork& work) {
  booked_.normal_damping += work.normal_damping;
  booked_.tangential_damping += work.tangential_damping;
  booked_.friction += work.spring;
  booked_.rolling_resistance += work.rolling;
  booked_.wall_work += work.wall;
  booked_.turnover += std::abs(work.wall);
}

ContactSurvey Simulation::survey() const {
  std::vector<Wall> then = walls;
  for (Wall& wall : then) wall.advance(-dt_);
  return survey_contacts(force_step_, rolling_model_, bodies_, contacts_, then);
}

EnergyLedger Simulation::ledger() const {
  EnergyLedger ledger = booked_;
  for (std::size_t i = 0; i < bodies_.count; ++i) {
    const BodyEnergy body = energy_of(bodies_, i, dt_, motion_step_.integrator);
    ledger.kinetic += body.kinetic;
    ledger.potential += body.potential;
  }
  const ContactSurvey contacts = survey();
  ledger.elastic_normal = contacts.elastic_normal;
  ledger.elastic_tangential = contacts.elastic_tangential;
  ledger.elastic_rolling = contacts.elastic_rolling;
  ledger.friction -= ledger.elastic_tangential;
  ledger.rolling_resistance -= ledger.elastic_rolling;
  return ledger;
}

void Simulation::add_strain(double energy) {
  booked_.added += energy;
  booked_.turnover += std::abs(energy);
}

void Simulation::add(const NewBody& body) {
  const std::size_t i = bodies_.add(body);
  const double brought = bodies_.kinetic_energy(i) + bodies_.motion[i].mass * kGravity * body.position.z();
  booked_.added += brought;
  booked_.turnover += std::abs(brought);
  contacts_.add_body(bodies_);
  if (rolling_model_ == RollingModel::type_a_relative)  // one contact is the least
    bodies_.motion[i].inertia_term =
        std::max({bodies_.inverse_i1[i], bodies_.inverse_i2[i], bodies_.inverse_i3[i]});
}

void Simulation::remove(std::span<const char> keep) {
  for (std::size_t i = 0; i < bodies_.count; ++i) {
    if (keep[i]) continue;
    const BodyEnergy body = energy_of(bodies_, i, dt_, motion_step_.integrator);
    booked_.removed += body.kinetic + body.potential;
  }
  const std::vector<int> new_index = bodies_.retain(keep);
  contacts_.renumber(bodies_, new_index, *crew_);
}

void Simulation::split_wall(int from, int plus, int minus) {
  contacts_.hand_over_wall(from, plus, 1.0);
  contacts_.hand_over_wall(from, minus, -1.0);
}

std::vector<char> Simulation::touching_another() const {
  std::vector<char> touches(bodies_.count, 0);
  contacts_.for_each_pair([&](const NearList& near, std::size_t k) {
    touches[near.first_body(k)] = touches[near.second_body(k)] = 1;
  });
  return touches;
}

HeapSnapshot Simulation::snapshot() const {
  HeapSnapshot heap;
  heap.time = time();
  for (std::size_t i = 0; i < bodies_.count; ++i) {
    BodySnapshot body;
    body.position = bodies_.position(i);
    body.orientation = bodies_.orientation(i);
    body.velocity = bodies_.velocity(i);
    body.angular_velocity = bodies_.angular_velocity(i);
    body.mass = bodies_.motion[i].mass;
    body.volume = body.mass / bodies_.density;
    body.shape = bodies_.shape[i];
    body.scale = bodies_.scale[i];
    heap.bodies.push_back(body);
    const Mat3 turn = body.orientation.toRotationMatrix();
    for (const Sphere& local : bodies_.spheres(i))
      heap.spheres.push_back({body.position + body.scale * (turn * local.centre), body.scale * local.radius,
                              static_cast<std::int32_t>(i)});
  }
  for (const Wall& wall : walls) {
    if (wall.kind == Wall::Kind::base) {
      heap.base_radius = wall.radius;
      heap.base_height = -wall.z_low;
    } else if (wall.present) {
      ShellSnapshot shell{wall.radius, wall.z_low, wall.z_high, wall.x_offset, ShellSnapshot::Part::whole};
      if (wall.kind == Wall::Kind::half_shell_plus) shell.part = ShellSnapshot::Part::half_positive_x;
      if (wall.kind == Wall::Kind::half_shell_minus) shell.part = ShellSnapshot::Part::half_negative_x;
      heap.shells.push_back(shell);
    }
  }
  return heap;
}

}  // namespace repose
