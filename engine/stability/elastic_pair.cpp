#include "engine/stability/elastic_pair.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/scene/particle_sizes.hpp"

namespace repose {

namespace {

Scene scene_of_pair(Scene scene, const ElasticPair& pair) {
  scene.particles.shapes = {sphere_clump(pair.radius)};
  scene.particles.size_classes.clear();
  scene.contact.particle_particle = {.restitution = 1.0, .static_friction = 0.0, .rolling_friction = 0.0};
  return scene;
}

/// One collision that begins at a part of a step, 0 … 1.
Probe collide(const Scene& scene, const ElasticPair& pair, double step, double phase,
              const Tolerance& tolerance) {
  Simulation simulation(scene, step);
  const double gap = (1.0 + phase) * pair.speed * step;
  for (const double side : {-1.0, 1.0}) {
    NewBody body;
    body.position = {side * (pair.radius + 0.5 * gap), 0.0, 0.0};
    body.velocity = {-side * 0.5 * pair.speed, 0.0, 0.0};
    simulation.add(body);
  }
  // Two steps to the contact, as many after it, and a quarter more for the drag of a coarse step.
  return watch_steps(simulation, {.duration = 1.25 * pair.contact_time + 4.0 * step,
                                  .look_interval = step,
                                  .energy = 0.5 * pair.m_eff * pair.speed * pair.speed,
                                  .overlap = pair.deepest / pair.radius,
                                  .tolerance = tolerance});
}

}  // namespace

ElasticPair elastic_pair(const Scene& scene) {
  ElasticPair pair;
  pair.radius = equivalent_sphere(scene.particles);
  pair.speed = fall_speed(scene.test);
  const double m = scene.particles.material.density * 4.0 / 3.0 * kPi * std::pow(pair.radius, 3);
  pair.m_eff = 0.5 * m;
  const double Y = Simulation(scene_of_pair(scene, pair), 1.0).laws().pair_law.young;
  const double R_eff = 0.5 * pair.radius, v = pair.speed;
  pair.deepest = std::pow(15.0 * pair.m_eff * v * v / (16.0 * Y * std::sqrt(R_eff)), 0.4);
  pair.contact_time = 2.868 * std::pow(pair.m_eff * pair.m_eff / (R_eff * Y * Y * v), 0.2);
  pair.stiffness_time = std::sqrt(pair.m_eff / (2.0 * Y * std::sqrt(R_eff * pair.deepest)));
  return pair;
}

Experiment elastic_pair_experiment(const Scene& scene, const Tolerance& tolerance) {
  const ElasticPair pair = elastic_pair(scene);
  return [pair, tolerance, scene = scene_of_pair(scene, pair)](double step) {
    Probe worst;
    worst.step = step;
    for (int k = 0; k < kPhases; ++k) {
      const Probe probe = collide(scene, pair, step, static_cast<double>(k) / kPhases, tolerance);
      if (!(std::abs(probe.energy_error) <= std::abs(worst.energy_error)))
        worst.energy_error = probe.energy_error;
      worst.overlap = std::max(worst.overlap, probe.overlap);
      if (worst.stable()) worst.failure = probe.failure;
    }
    return worst;
  };
}

}  // namespace repose
