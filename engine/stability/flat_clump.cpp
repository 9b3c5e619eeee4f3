#include "engine/stability/flat_clump.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/scene/particle_sizes.hpp"
#include "engine/slump/motion_watch.hpp"

namespace repose {

namespace {

constexpr double kTilt = 0.05;   ///< [rad]
constexpr double kClear = 0.02;  ///< of the clump's width, between plate and lowest sphere at the beginning

Quat tilted() { return Quat(Eigen::AngleAxisd(kTilt, Vec3(2.0, 1.0, 0.0).normalized())); }

Scene scene_of_clump(Scene scene, const FlatClump& flat) {
  scene.particles.shapes = {flat.clump};
  scene.particles.size_classes.clear();
  return scene;
}

Simulation falling(const Scene& scene, const FlatClump& flat, double step) {
  Simulation simulation(scene, step);
  simulation.walls = {Wall{}};
  NewBody body;
  body.orientation = tilted();
  body.position = {0.0, 0.0, flat.height + flat.clump.smallest_radius()};
  body.velocity = {flat.speed, 0.0, 0.0};
  simulation.add(body);
  return simulation;
}

}  // namespace

FlatClump flat_clump(const Scene& scene) {
  FlatClump flat;
  const Particles& particles = scene.particles;
  std::size_t most = 0;
  for (const Clump& shape : particles.shapes) most = std::max(most, shape.spheres.size());
  const int n = std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(most)))));
  const double width = 2.0 * equivalent_sphere(particles);
  const double radius = std::min(smallest_sphere(particles), 0.5 * width / n);
  const double spacing = (width - 2.0 * radius) / (n - 1);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      flat.clump.spheres.push_back(
          {Vec3(spacing * (i - 0.5 * (n - 1)), spacing * (j - 0.5 * (n - 1)), 0.0), radius});
  flat.clump.volume = kPi / 6.0 * width * width * width;
  const double thick = 4.0 * radius * radius;
  flat.clump.inertia =
      flat.clump.volume / 12.0 * Vec3(width * width + thick, width * width + thick, 2.0 * width * width);
  flat.contacts = n * n;
  flat.mass = particles.material.density * flat.clump.volume;
  double lowest = 0.0;
  for (const Sphere& sphere : flat.clump.spheres) lowest = std::min(lowest, (tilted() * sphere.centre).z());
  flat.height = kClear * width - lowest;
  flat.speed = std::sqrt(0.1 * kGravity * width);
  flat.duration = 12.0 * std::sqrt(2.0 * flat.height / kGravity);
  return flat;
}

FlatMotion flat_motion(const Scene& scene) {
  const FlatClump flat = flat_clump(scene);
  Scene own = scene_of_clump(scene, flat);
  own.numerics.integrator = Integrator::symplectic_euler;
  const double step = 0.2 * automatic_time_step(scene);
  Simulation simulation = falling(own, flat, step);
  MotionWatch watch(own);
  const auto steps = static_cast<long>(flat.duration / step);
  constexpr long kPerLook = 4;  // some twenty looks an oscillation
  for (long k = 0; k < steps && simulation.step(); ++k)
    if (k % kPerLook == 0 && watch.check_contacts(simulation)) break;
  return {1.0 / std::sqrt(watch.diagnosis().stiffest), watch.diagnosis().largest_overlap_ratio};
}

Experiment flat_clump_experiment(const Scene& scene, const FlatMotion& sound, const Tolerance& tolerance,
                                 const std::atomic<bool>* stop) {
  const FlatClump flat = flat_clump(scene);
  const double brought = flat.mass * (0.5 * flat.speed * flat.speed + kGravity * flat.height);
  return [flat, brought, sound, tolerance, stop, scene = scene_of_clump(scene, flat)](double step) {
    Simulation simulation = falling(scene, flat, step);
    return watch_steps(simulation, {.duration = flat.duration,
                                    .look_interval = 0.2 * sound.stiffness_time,
                                    .energy = brought,
                                    .overlap = sound.deepest,
                                    .tolerance = tolerance,
                                    .stop = stop});
  };
}

}  // namespace repose
