#include "sweep/cost_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/vec3.hpp"

namespace repose::sweep {

namespace {

constexpr double kFractionOfAuto = 0.3;
constexpr double kTimeAfterPouring = 1.0;  // to settle, open and come to rest [s]

/// Mean and smallest over shapes and size classes.
struct Bodies {
  double mean_volume = 0.0;
  double mean_spheres = 0.0;
  double smallest_radius = INFINITY;
};

Bodies bodies_of(const Particles& particles) {
  Bodies bodies;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(particles.shapes.size(), 1));
  for (const Clump& shape : particles.shapes) {
    double smallest_scale = particles.size_classes.empty() ? 1.0 : INFINITY;
    for (const SizeClass& size : particles.size_classes)
      smallest_scale = std::min(smallest_scale, std::cbrt(size.volume_min / shape.volume));
    bodies.smallest_radius = std::min(bodies.smallest_radius, smallest_scale * shape.smallest_radius());
    bodies.mean_spheres += share * static_cast<double>(shape.spheres.size());
    if (particles.size_classes.empty()) bodies.mean_volume += share * shape.volume;
  }
  for (const SizeClass& size : particles.size_classes)
    bodies.mean_volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  return bodies;
}

double time_step_of(const Scene& scene, double smallest_radius) {
  if (scene.numerics.time_step) return *scene.numerics.time_step;
  const Material& material = scene.particles.material;
  const double shear_modulus = material.shear_modulus * scene.numerics.stiffness_scale;
  const double rayleigh_time = kPi * smallest_radius * std::sqrt(material.density / shear_modulus) /
                               (0.163 * material.poisson_ratio + 0.8766);
  return scene.numerics.time_step_fraction.value_or(kFractionOfAuto) * rayleigh_time;
}

}  // namespace

double estimated_work(const Scene& scene) {
  const Bodies bodies = bodies_of(scene.particles);
  const double count = scene.particles.total_mass / (scene.particles.material.density * bodies.mean_volume);
  const double pouring =
      scene.test.filling == Filling::pour ? scene.particles.total_mass / scene.test.pour_rate : 0.0;
  const double duration = pouring + kTimeAfterPouring;
  return count * bodies.mean_spheres * duration / time_step_of(scene, bodies.smallest_radius);
}

CostModel::CostModel(std::vector<double> work_of_points)
    : work_(std::move(work_of_points)), measured_(work_.size()) {}

void CostModel::learn(std::size_t point, double cpu_seconds) {
  measured_[point].seconds += cpu_seconds;
  ++measured_[point].runs;
  total_seconds_ += cpu_seconds;
  total_work_ += work_[point];
}

std::optional<double> CostModel::seconds(std::size_t point) const {
  if (const Measured& own = measured_[point]; own.runs > 0) return own.seconds / own.runs;
  if (total_work_ > 0.0) return total_seconds_ / total_work_ * work_[point];
  return std::nullopt;
}

double CostModel::weight(std::size_t point) const { return seconds(point).value_or(work_[point]); }

}  // namespace repose::sweep
