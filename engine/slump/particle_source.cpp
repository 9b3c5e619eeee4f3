#include "engine/slump/particle_source.hpp"

#include <cmath>

namespace repose {

namespace {

/// One combination of shape and size class with its share of all particles.
struct Combination {
  int shape = 0;
  const SizeClass* size = nullptr;  ///< null: the shape's own size
  double share = 0.0;
  double drawn = 0.0;
};

std::vector<Combination> combinations_of(const Particles& particles) {
  std::vector<Combination> list;
  const double per_shape = 1.0 / static_cast<double>(particles.shapes.size());
  for (std::size_t shape = 0; shape < particles.shapes.size(); ++shape) {
    if (particles.size_classes.empty()) list.push_back({static_cast<int>(shape), nullptr, per_shape});
    for (const SizeClass& size : particles.size_classes)
      list.push_back({static_cast<int>(shape), &size, per_shape * size.number_fraction});
  }
  return list;
}

}  // namespace

std::vector<ParticleDraw> draw_particles(const Particles& particles, RandomStream& random) {
  std::vector<Combination> combinations = combinations_of(particles);
  std::vector<ParticleDraw> draws;
  double poured = 0.0;
  for (;;) {
    Combination* next = &combinations.front();
    const double count = static_cast<double>(draws.size()) + 1.0;
    for (Combination& candidate : combinations)
      if (candidate.share * count - candidate.drawn > next->share * count - next->drawn) next = &candidate;

    const Clump& shape = particles.shapes[static_cast<std::size_t>(next->shape)];
    const double u = random.uniform();  // drawn for every particle, so that all scenes use the stream alike
    const double volume = next->size
                              ? next->size->volume_min + u * (next->size->volume_max - next->size->volume_min)
                              : shape.volume;
    const double mass = particles.material.density * volume;
    if (!draws.empty() && poured + 0.5 * mass > particles.total_mass) return draws;
    next->drawn += 1.0;
    poured += mass;
    draws.push_back({next->shape, std::cbrt(volume / shape.volume), mass});
  }
}

}  // namespace repose
