#include "engine/slump/packing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "engine/scene/names.hpp"
#include "engine/slump/slump_test.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

struct PlacedBody {
  std::vector<Sphere> spheres;
};

std::vector<PlacedBody> placed(const Particles& particles, const Packing& packing) {
  std::vector<PlacedBody> bodies;
  for (const NewBody& body : packing.bodies) {
    PlacedBody& one = bodies.emplace_back();
    const Mat3 turn = body.orientation.toRotationMatrix();
    for (const Sphere& s : particles.shapes[static_cast<std::size_t>(body.shape)].spheres)
      one.spheres.push_back({body.position + body.scale * (turn * s.centre), body.scale * s.radius});
  }
  return bodies;
}

/// Smallest gap between any two bodies, or a body and the cylinder or the base, by looking at all of them
/// [m].
double smallest_gap(const std::vector<PlacedBody>& bodies, double radius) {
  double smallest = 1.0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Sphere& a : bodies[i].spheres) {
      smallest = std::min(
          {smallest, a.centre.z() - a.radius, radius - std::hypot(a.centre.x(), a.centre.y()) - a.radius});
      for (std::size_t j = 0; j < i; ++j)
        for (const Sphere& b : bodies[j].spheres)
          smallest = std::min(smallest, (a.centre - b.centre).norm() - a.radius - b.radius);
    }
  return smallest;
}

struct PackingCase {
  const char* name;
  std::vector<Clump> shapes;
  std::vector<SizeClass> classes;
  double radius;  ///< of the cylinder [m]
};
void PrintTo(const PackingCase& c, std::ostream* stream) { *stream << c.name; }

std::vector<PackingCase> packing_cases() {
  RandomStream random(17, 1);
  const Clump clump = random_clump(random, 6, 4e-3);
  // Three spheres in a row, the longest three times as long as wide.
  const Clump rod = summed_clump({{{-5e-3, 0, 0}, 2.5e-3}, {Vec3::Zero(), 2.5e-3}, {{5e-3, 0, 0}, 2.5e-3}});
  return {{"spheres", {sphere_clump(4e-3)}, {}, 0.03},
          {"spheresOfTwoSizes", {sphere_clump(4e-3)}, {{5e-8, 5e-8, 0.8}, {1e-6, 1e-6, 0.2}}, 0.04},
          {"clumps", {clump}, {}, 0.03},
          {"rodsAndSpheres", {rod, sphere_clump(4e-3)}, {}, 0.03},
          {"rodsInANarrowTube", {rod}, {}, 0.0102}};
}

class PackingOf : public testing::TestWithParam<PackingCase> {};

TEST_P(PackingOf, LeavesNoOverlapAndKeepsItsFraction) {
  Particles particles;
  particles.material = kGlass;
  particles.shapes = GetParam().shapes;
  particles.size_classes = GetParam().classes;
  particles.total_mass = GetParam().radius < 0.02 ? 0.01 : 0.3;
  RandomStream sizes(2, 1);
  const std::vector<ParticleDraw> draws = draw_particles(particles, sizes);
  for (const double fraction : {0.25, 0.5}) {
    RandomStream random(3, 2);
    Crew alone;
    const Packing packing = pack_cylinder(particles, draws, GetParam().radius, fraction, random, alone);
    ASSERT_TRUE(packing.clear);
    ASSERT_EQ(packing.bodies.size(), draws.size());
    EXPECT_GE(smallest_gap(placed(particles, packing), GetParam().radius), 0.0);
    const double volume = particles.total_mass / particles.material.density;
    const double reached = volume / (kPi * std::pow(GetParam().radius, 2) * packing.top);
    // Never denser than asked but for the last layer, which ends in tops; and found without much stretching,
    // but in the tube that one rod spans.
    EXPECT_LT(reached, 1.25 * fraction);
    EXPECT_GT(reached, (GetParam().radius < 0.02 ? 0.3 : 0.75) * fraction);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, PackingOf, testing::ValuesIn(packing_cases()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Packing, IsTheSameForAnyNumberOfThreads) {
  Particles particles;
  particles.material = kGlass;
  RandomStream shapes(7, 1);
  particles.shapes = {random_clump(shapes, 8, 4e-3), sphere_clump(3e-3)};
  particles.total_mass = 0.5;  // some hundred bodies in a dozen layers
  RandomStream sizes(2, 1);
  const std::vector<ParticleDraw> draws = draw_particles(particles, sizes);
  const auto pack = [&](int helpers) {
    Crew crew(helpers);
    while (crew.joined() < helpers) std::this_thread::yield();
    crew.admit();
    RandomStream random(3, 2);
    return pack_cylinder(particles, draws, 0.03, 0.45, random, crew);
  };
  const Packing alone = pack(0);
  ASSERT_TRUE(alone.clear);
  for (const int helpers : {1, 2, 3}) {
    const Packing together = pack(helpers);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      ASSERT_EQ(together.bodies[i].position, alone.bodies[i].position) << i;
      ASSERT_EQ(together.bodies[i].orientation.coeffs(), alone.bodies[i].orientation.coeffs()) << i;
    }
  }
}

TEST(Packing, FillsTheCylinderEvenly) {
  // Mean of (ρ/R)² over an even filling is ½ (R less a radius: half of (1 − r/R)²); of z it is half the
  // height. 500 spheres: four standard errors of ρ² (√(1/12)/√n) are 0.05, of z the same of the height.
  Particles particles;
  particles.material = kGlass;
  particles.shapes = {sphere_clump(3e-3)};
  particles.total_mass = 500.0 * kGlass.density * particles.shapes.front().volume;
  RandomStream sizes(2, 1), random(5, 2);
  const auto draws = draw_particles(particles, sizes);
  Crew alone;
  const Packing packing = pack_cylinder(particles, draws, 0.04, 0.25, random, alone);
  double square = 0.0, height = 0.0;
  for (const NewBody& body : packing.bodies) {
    square += std::pow(std::hypot(body.position.x(), body.position.y()) / 0.037, 2);
    height += body.position.z() / packing.top;
  }
  EXPECT_NEAR(square / 500.0, 0.5, 0.06);
  EXPECT_NEAR(height / 500.0, 0.5, 0.06);
}

class FillingOf : public testing::TestWithParam<Filling> {};

TEST_P(FillingOf, GivesTheSameParticlesAndAHeap) {
  Scene scene = tiny_scene();
  const auto masses = [](const SlumpTestRun& run) {
    std::vector<double> list;
    for (const ParticleDraw& draw : run.pour().particles()) list.push_back(draw.mass);
    return list;
  };
  const RunOptions options;
  SlumpTestRun poured(scene, 4, options);
  scene.test.filling = GetParam();
  SlumpTestRun run(scene, 4, options);
  run.run();
  ASSERT_EQ(run.outcome(), Outcome::completed) << run.reason();
  EXPECT_EQ(masses(run), masses(poured));
  EXPECT_EQ(run.column().bodies.size(), run.pour().particles().size());
  // No shell is left higher than the case's cylinder, and what rained from above its rim is inside.
  for (const BodySnapshot& body : run.column().bodies)
    EXPECT_LT(body.position.z(), scene.test.cylinder_height);
}

TEST_P(FillingOf, ReachesAboveTheRimAndSettlesIntoTheCylinder) {
  // The tiny scene's column settles to about 31 mm: 40 mm hold it, but not the loose particles.
  Scene scene = tiny_scene();
  scene.test.filling = GetParam();
  scene.test.cylinder_height = 0.04;
  const RunOptions options;
  SlumpTestRun run(scene, 4, options);
  run.run();
  EXPECT_GT(run.pour().top(), 0.04);
  EXPECT_EQ(run.outcome(), Outcome::completed) << run.reason();
  EXPECT_EQ(run.diagnosis().spilled, 0);
}

TEST_P(FillingOf, EndsOverfullWhereThereIsNoRoom) {
  Scene scene = tiny_scene();
  scene.test.filling = GetParam();
  for (const double mass : {0.6, 3.0}) {  // more than fits when settled; more than the cylinder's volume
    scene.particles.total_mass = mass;
    const RunOptions options;
    SlumpTestRun run(scene, 1, options);
    run.run();
    EXPECT_EQ(run.outcome(), Outcome::overfull) << mass << ": " << run.reason();
  }
}

INSTANTIATE_TEST_SUITE_P(AllAtOnce, FillingOf, testing::Values(Filling::rain, Filling::packing),
                         [](const auto& info) { return std::string(choice_name(info.param)); });

}  // namespace
}  // namespace repose::test
