#include "engine/scene/particle_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace repose {

double smallest_scale(const Particles& particles, const Clump& shape) {
  if (particles.size_classes.empty()) return 1.0;
  double volume = std::numeric_limits<double>::infinity();
  for (const SizeClass& size : particles.size_classes) volume = std::min(volume, size.volume_min);
  return std::cbrt(volume / shape.volume);
}

double smallest_sphere(const Particles& particles) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Clump& shape : particles.shapes)
    radius = std::min(radius, smallest_scale(particles, shape) * shape.smallest_radius());
  return radius;
}

double equivalent_sphere(const Particles& particles) {
  double volume = std::numeric_limits<double>::infinity();
  for (const Clump& shape : particles.shapes)
    volume = std::min(volume, std::pow(smallest_scale(particles, shape), 3) * shape.volume);
  return std::cbrt(3.0 * volume / (4.0 * kPi));
}

LargestSizes largest_sizes(const Particles& particles) {
  LargestSizes sizes;
  const double share = 1.0 / static_cast<double>(particles.shapes.size());
  double largest_class = 0.0;
  for (const SizeClass& size : particles.size_classes) {
    largest_class = std::max(largest_class, size.volume_max);
    sizes.mean_volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  }
  for (const Clump& shape : particles.shapes) {
    const double scale = particles.size_classes.empty() ? 1.0 : std::cbrt(largest_class / shape.volume);
    if (particles.size_classes.empty()) sizes.mean_volume += share * shape.volume;
    sizes.diameter = std::max(sizes.diameter, scale * shape.equivalent_diameter());
    sizes.span = std::max(sizes.span, scale * 2.0 * shape.bounding_radius());
  }
  return sizes;
}

}  // namespace repose
