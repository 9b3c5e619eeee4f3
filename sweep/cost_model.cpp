#include "sweep/cost_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/vec3.hpp"
#include "engine/dynamics/time_step.hpp"

namespace repose::sweep {

namespace {

constexpr double kTimeAfterPouring = 1.0;  // to settle, open and come to rest [s]
constexpr double kSearches = 200.0;

/// Means over shapes and size classes.
struct Bodies {
  double volume = 0.0;
  double spheres = 0.0;
};

Bodies mean_of(const Particles& particles) {
  Bodies mean;
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(particles.shapes.size(), 1));
  for (const Clump& shape : particles.shapes) {
    mean.spheres += share * static_cast<double>(shape.spheres.size());
    if (particles.size_classes.empty()) mean.volume += share * shape.volume;
  }
  for (const SizeClass& size : particles.size_classes)
    mean.volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  return mean;
}

}  // namespace

double estimated_work(const Scene& scene) {
  const Bodies mean = mean_of(scene.particles);
  const double count = scene.particles.total_mass / (scene.particles.material.density * mean.volume);
  const double pouring =
      scene.test.filling == Filling::pour ? scene.particles.total_mass / scene.test.pour_rate : 0.0;
  const double diameter = std::cbrt(6.0 * mean.volume / kPi);
  const double rate = 1.0 / time_step(scene) + kSearches * fall_speed(scene.test) / diameter;
  return count * std::sqrt(mean.spheres) * (pouring + kTimeAfterPouring) * rate;
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
