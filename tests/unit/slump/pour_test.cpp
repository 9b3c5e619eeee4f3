#include "engine/slump/pour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

/// Largest overlap of a body from number `first` on with any other, in units of the smaller radius.
double largest_overlap(const HeapSnapshot& heap, std::size_t first) {
  double largest = 0.0;
  for (const SphereSnapshot& p : heap.spheres)
    for (const SphereSnapshot& q : heap.spheres) {
      if (p.body <= q.body || static_cast<std::size_t>(p.body) < first) continue;
      const double overlap = p.radius + q.radius - (p.centre - q.centre).norm();
      largest = std::max(largest, overlap / std::min(p.radius, q.radius));
    }
  return largest;
}

TEST(Pour, PlacesBodiesClearOfEachOtherAndOfTheCylinder) {
  RandomStream random(61, 1);
  Scene scene = tiny_scene();
  scene.particles.shapes = {random_clump(random, 4, 5e-3), sphere_clump(4e-3)};
  scene.test.pour_rate = 100.0;  // all at once: what finds no room waits
  Simulation simulation(scene, 1e-5);
  Pour pour(scene, 3);
  std::size_t before = 0;
  for (int call = 0; call < 40; ++call) {
    pour.advance(simulation);
    const HeapSnapshot heap = simulation.snapshot();
    EXPECT_EQ(largest_overlap(heap, before), 0.0);
    for (std::size_t i = before; i < heap.bodies.size(); ++i)
      EXPECT_DOUBLE_EQ(heap.bodies[i].velocity.z(), -scene.test.pour_speed);
    for (const SphereSnapshot& s : heap.spheres)
      EXPECT_LE(std::hypot(s.centre.x(), s.centre.y()) + s.radius, scene.test.cylinder_radius + 1e-12);
    before = heap.bodies.size();
    for (int k = 0; k < 300; ++k) simulation.step();
    if (call > 0 && !pour.done()) {
      EXPECT_GT(pour.waiting(simulation), 0.0);
    }
  }
  EXPECT_GT(before, 20U);
}

TEST(Pour, KeepsToItsRate) {
  const Scene scene = tiny_scene();
  Simulation simulation(scene, 1e-4);
  simulation.walls = {floor_wall()};
  Pour pour(scene, 3);
  const double one = scene.particles.material.density * scene.particles.shapes.front().volume;
  while (!pour.done()) {
    pour.advance(simulation);
    EXPECT_NEAR(pour.poured_mass(), std::min(scene.test.pour_rate * simulation.time(), pour.total_mass()),
                1.01 * one);
    simulation.step();
  }
  EXPECT_DOUBLE_EQ(pour.poured_mass(), pour.total_mass());
}

Particles classes() {
  Particles particles;
  particles.material = kGlass;
  particles.shapes = {sphere_clump(1e-3), sphere_clump(2e-3), sphere_clump(5e-3)};
  particles.size_classes = {{1e-7, 2e-7, 0.44}, {2e-7, 3e-7, 0.25}, {3e-7, 4e-7, 0.22}, {5e-7, 5e-7, 0.09}};
  particles.total_mass = 0.5;
  return particles;
}

TEST(DrawParticles, HoldTheAskedMassShapesAndSizeClasses) {
  const Particles particles = classes();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RandomStream random(seed, 1);
    const std::vector<ParticleDraw> draws = draw_particles(particles, random);
    double mass = 0.0, largest = 0.0;
    std::map<int, double> of_shape;
    std::map<std::size_t, double> of_class;
    for (const ParticleDraw& draw : draws) {
      mass += draw.mass;
      largest = std::max(largest, draw.mass);
      const double volume = draw.mass / particles.material.density;
      const Clump& shape = particles.shapes[static_cast<std::size_t>(draw.shape)];
      EXPECT_NEAR(shape.volume * std::pow(draw.scale, 3) / volume, 1.0, 1e-12);
      of_shape[draw.shape] += 1.0;
      for (std::size_t k = 0; k < particles.size_classes.size(); ++k)
        if (volume >= particles.size_classes[k].volume_min - 1e-20 &&
            volume < particles.size_classes[k].volume_max + (k == 3 ? 1e-12 : -1e-20))
          of_class[k] += 1.0;
    }
    EXPECT_NEAR(mass, particles.total_mass, 0.5 * largest + 1e-12);
    const auto n = static_cast<double>(draws.size());
    for (const auto& [shape, count] : of_shape) EXPECT_NEAR(count, n / 3.0, 4.0) << shape;
    // Within one particle of its share for each of the three shapes.
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(of_class[k], n * particles.size_classes[k].number_fraction, 3.0);
  }
}

TEST(DrawParticles, HoldTheirSharesAtEveryMomentOfThePour) {
  const Particles particles = classes();
  RandomStream random(2, 1);
  const std::vector<ParticleDraw> draws = draw_particles(particles, random);
  double count[3] = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < draws.size(); ++k) {
    count[draws[k].shape] += 1.0;
    for (const double c : count) EXPECT_NEAR(c, static_cast<double>(k + 1) / 3.0, 4.0);
  }
}

TEST(DrawParticles, FillARangeOfVolumesEvenly) {
  Particles particles = classes();
  particles.shapes.resize(1);
  particles.size_classes = {{1e-7, 5e-7, 1.0}};
  particles.total_mass = 2.0;
  RandomStream random(4, 1);
  const std::vector<ParticleDraw> draws = draw_particles(particles, random);
  double sum = 0.0, squares = 0.0;
  for (const ParticleDraw& draw : draws) {
    const double u = (draw.mass / particles.material.density - 1e-7) / 4e-7;
    EXPECT_GE(u, -1e-12);
    EXPECT_LE(u, 1.0 + 1e-12);
    sum += u, squares += u * u;
  }
  // Mean ½ ± 4/√(12 n), mean square ⅓ ± 4 √(4/45/n).
  const auto n = static_cast<double>(draws.size());
  EXPECT_NEAR(sum / n, 0.5, 4.0 / std::sqrt(12.0 * n));
  EXPECT_NEAR(squares / n, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / n));
}

TEST(DrawParticles, GiveOneParticleWhereTheMassIsTiny) {
  Particles particles = classes();
  particles.total_mass = 1e-9;
  RandomStream random(1, 1);
  EXPECT_EQ(draw_particles(particles, random).size(), 1U);
}

}  // namespace
}  // namespace repose::test
