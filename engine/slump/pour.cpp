#include "engine/slump/pour.hpp"

#include <algorithm>
#include <cmath>

#include "engine/slump/curve_order.hpp"
#include "engine/slump/packing.hpp"

namespace repose {

namespace {

// Streams of a run's seed: what is poured does not depend on how often a place is tried.
constexpr std::uint64_t kParticleStream = 1;
constexpr std::uint64_t kPlacementStream = 2;
constexpr int kAttempts = 30;

std::vector<ParticleDraw> draw(const Scene& scene, std::uint64_t seed) {
  RandomStream random(seed, kParticleStream);
  return draw_particles(scene.particles, random);
}

/// Whether two bodies' spheres keep clear of each other.
bool clear_of(const Bodies& bodies, std::size_t other, const Clump& shape, const NewBody& body) {
  const Mat3 turn = body.orientation.toRotationMatrix();
  const Mat3 other_turn = bodies.orientation(other).toRotationMatrix();
  for (const Sphere& a : shape.spheres) {
    const Vec3 centre = body.position + body.scale * (turn * a.centre);
    for (const Sphere& b : bodies.spheres(other)) {
      const Vec3 gap = centre - bodies.position(other) - bodies.scale[other] * (other_turn * b.centre);
      const double reach = body.scale * a.radius + bodies.scale[other] * b.radius;
      if (gap.squaredNorm() <= reach * reach) return false;
    }
  }
  return true;
}

}  // namespace

Pour::Pour(const Scene& scene, std::uint64_t seed)
    : scene_(scene), placement_(seed, kPlacementStream), particles_(draw(scene, seed)) {
  for (const ParticleDraw& particle : particles_) total_mass_ += particle.mass;
}

double Pour::waiting(const Simulation& simulation) const {
  return done() ? 0.0 : simulation.time() - last_success_;
}

void Pour::advance(Simulation& simulation) {
  if (scene_.test.filling != Filling::pour) return place_all(simulation);
  const double due = scene_.test.pour_rate * simulation.time();
  while (!done() && poured_mass_ <= due) {
    if (!try_to_place(simulation, particles_[next_])) break;
    poured_mass_ += particles_[next_++].mass;
    last_success_ = simulation.time();
  }
  if (poured_mass_ > due) last_success_ = simulation.time();  // none is due, so none waits
  last_call_ = simulation.time();
}

void Pour::place(Simulation& simulation, const std::vector<NewBody>& column, double strain) {
  for (const NewBody& body : column) simulation.add(body);
  simulation.add_strain(strain);
  poured_mass_ = total_mass_;
  next_ = particles_.size();
}

void Pour::place_all(Simulation& simulation) {
  if (done()) return;
  const SlumpTest& test = scene_.test;
  const double inside = kPi * test.cylinder_radius * test.cylinder_radius * test.cylinder_height;
  no_room_ = total_mass_ / scene_.particles.material.density > inside;
  if (no_room_) return;
  const bool rain = test.filling == Filling::rain;
  const Packing packing =
      pack_cylinder(scene_.particles, particles_, test.cylinder_radius,
                    rain ? kRainFraction : kPackingFraction, placement_, simulation.crew());
  no_room_ = !packing.clear;
  if (no_room_) return;
  std::vector<Vec3> places;
  for (const NewBody& body : packing.bodies) places.push_back(body.position);
  for (const std::size_t k : curve_order(places, std::cbrt(total_mass_ / static_cast<double>(places.size()) /
                                                           scene_.particles.material.density))) {
    NewBody body = packing.bodies[k];
    if (rain) body.velocity = {0.0, 0.0, -test.pour_speed};
    simulation.add(body);
  }
  top_ = packing.top;
  poured_mass_ = total_mass_;
  next_ = particles_.size();
}

bool Pour::try_to_place(Simulation& simulation, const ParticleDraw& particle) {
  const SlumpTest& test = scene_.test;
  const Clump& shape = scene_.particles.shapes[static_cast<std::size_t>(particle.shape)];
  const double reach = particle.scale * shape.bounding_radius();
  NewBody body;
  body.shape = particle.shape;
  body.scale = particle.scale;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const double radius = (test.cylinder_radius - reach) * std::sqrt(placement_.uniform());
    const double angle = 2.0 * kPi * placement_.uniform();
    // Particles of one call spread over what the stream travels between calls, so that they do not come in
    // sheets.
    const double fallen = test.pour_speed * (simulation.time() - last_call_) * placement_.uniform();
    const double top = std::max(test.cylinder_height - reach, reach);
    body.position = {radius * std::cos(angle), radius * std::sin(angle), std::max(top - fallen, reach)};
    body.velocity = {0.0, 0.0, -test.pour_speed};
    body.orientation = placement_.rotation();
    if (!fits(simulation.bodies(), body, reach)) continue;
    simulation.add(body);
    return true;
  }
  return false;
}

bool Pour::fits(const Bodies& bodies, const NewBody& body, double reach) const {
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const double apart = reach + bodies.reach[i];
    if (std::abs(bodies.z[i] - body.position.z()) > apart) continue;
    if ((bodies.position(i) - body.position).squaredNorm() > apart * apart) continue;
    if (!clear_of(bodies, i, scene_.particles.shapes[static_cast<std::size_t>(body.shape)], body))
      return false;
  }
  return true;
}

}  // namespace repose
