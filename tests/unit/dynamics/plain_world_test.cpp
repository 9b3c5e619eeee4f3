#include <gtest/gtest.h>

#include <algorithm>

#include "reference/plain_world.hpp"
#include "support/test_scene.hpp"

namespace repose::test {
namespace {

/// A short violent run: clumps and spheres of several sizes shot at each other in a cylinder that splits,
/// with bodies added and removed on the way. At every step the loads of all bodies are those of brute force
/// over all spheres with histories in a map: no touching pair is missed and no history is lost or mixed up,
/// across listings, removals and the hand-over of the wall.
struct ViolentRun {
  RollingModel rolling;
  TangentialHistory history;
  NormalDamping damping;
  Arithmetic arithmetic = Arithmetic::double_precision;
};

class EveryStep : public testing::TestWithParam<ViolentRun> {
 protected:
  static Scene scene(const ViolentRun& choice, RandomStream& random) {
    std::vector<Clump> shapes{sphere_clump(4e-3), random_clump(random, 3, 5e-3),
                              random_clump(random, 7, 7e-3)};
    Scene scene = scene_of(shapes, kGlass, {0.5, 0.6, 0.2}, choice.rolling);
    scene.contact.particle_wall = {0.7, 0.4, 0.1};
    scene.walls = {7800.0, 8e7, 0.3};
    scene.contact.tangential_history = choice.history;
    scene.contact.normal_damping = choice.damping;
    scene.numerics.arithmetic = choice.arithmetic;
    return scene;
  }

  static NewBody body(RandomStream& random, double low, double high) {
    NewBody b;
    b.shape = static_cast<int>(random.below(3));
    b.scale = random.uniform(0.6, 1.4);
    const double rho = 0.03 * std::sqrt(random.uniform()), phi = random.uniform(0.0, 2.0 * kPi);
    b.position = {rho * std::cos(phi), rho * std::sin(phi), random.uniform(low, high)};
    b.orientation = random.rotation();
    b.velocity = 2.0 * Vec3(random.normal(), random.normal(), random.normal());
    b.angular_velocity = 100.0 * Vec3(random.normal(), random.normal(), random.normal());
    return b;
  }
};

TEST_P(EveryStep, HasTheLoadsOfBruteForce) {
  RandomStream random(31, 1);
  const Scene scene = EveryStep::scene(GetParam(), random);
  const double dt = 4e-6;
  Simulation simulation(scene, dt, std::make_shared<Crew>(2), 8);  // three or four sections for three threads
  Wall base;
  base.radius = 0.055;
  base.z_low = -0.05;
  const Wall cylinder{Wall::Kind::closed_shell, 0.045, 0.0, 0.1, 0.0};
  simulation.walls = {base, cylinder};
  for (int k = 0; k < 24; ++k) simulation.add(body(random, 0.01, 0.05));

  reference::ContactMaterial pair =
      reference::plain_material(scene, scene.particles.material, scene.contact.particle_particle);
  reference::ContactMaterial wall =
      reference::plain_material(scene, scene.walls, scene.contact.particle_wall);
  for (auto* material : {&pair, &wall}) material->beta_clamped = clamped_damping_ratio(material->e);
  reference::PlainWorld plain(pair, wall);

  std::size_t most_contacts = 0;
  bool wall_pulled = false;
  for (int step = 0; step < 5000; ++step) {
    if (step == 700) simulation.add(body(random, 0.09, 0.1));
    if (step % 900 == 899)
      simulation.remove_if([&](std::size_t i) { return simulation.bodies().id[i] % 7 == step / 900; });
    if (step == 2500) {
      Wall half{Wall::Kind::half_shell_plus, 0.045, 0.0, 0.1, 0.0};
      half.velocity = {0.5, 0.0, 0.0};
      simulation.walls[1].present = false;
      simulation.walls.push_back(half);
      half.kind = Wall::Kind::half_shell_minus;
      half.velocity = {-0.5, 0.0, 0.0};
      simulation.walls.push_back(half);
      simulation.split_wall(1, 2, 3);
      plain.hand_over(1, 2, 3);
      wall_pulled = true;
    }
    const Bodies before = simulation.bodies();
    const auto loads = plain.loads(before, simulation.walls, dt);
    most_contacts = std::max(most_contacts, plain.contacts());
    ASSERT_TRUE(simulation.step());
    const Bodies& after = simulation.bodies();
    for (std::size_t i = 0; i < after.count; ++i) {
      // Positions come from the engine at every step; only histories run on by themselves. What accumulates
      // in them is rounding. Of what the forces are sums of it is 1e-12 at most over the whole run, 1.5e-6
      // with mixed arithmetic.
      const double rounding = GetParam().arithmetic == Arithmetic::mixed ? 1e-5 : 1e-11;
      const double bar = rounding * (loads[i].parts + 1e-6);
      ASSERT_EQ(static_cast<int>(after.load[i].contacts), loads[i].contacts)
          << "step " << step << " body " << i;
      ASSERT_LT((Vec3(after.load[i].force) - loads[i].force).norm(), bar) << "step " << step << " body " << i;
      ASSERT_LT((Vec3(after.load[i].torque) - loads[i].torque).norm(), bar * 0.01)
          << "step " << step << " body " << i;
      ASSERT_NEAR(after.load[i].rolling, loads[i].rolling, bar * 0.01) << "step " << step << " body " << i;
    }
  }
  EXPECT_GT(most_contacts, 15U);
  EXPECT_GT(simulation.contacts().updates(), 30);
  EXPECT_TRUE(wall_pulled);
}

INSTANTIATE_TEST_SUITE_P(
    LawsOfContact, EveryStep,
    testing::Values(
        ViolentRun{RollingModel::type_a, TangentialHistory::force, NormalDamping::with_tail},
        ViolentRun{RollingModel::type_a_relative, TangentialHistory::displacement, NormalDamping::with_tail},
        ViolentRun{RollingModel::type_c, TangentialHistory::force, NormalDamping::clamped},
        ViolentRun{RollingModel::type_c_undamped, TangentialHistory::displacement, NormalDamping::with_tail},
        ViolentRun{RollingModel::type_a, TangentialHistory::force, NormalDamping::with_tail,
                   Arithmetic::mixed},
        ViolentRun{RollingModel::type_a_relative, TangentialHistory::displacement, NormalDamping::clamped,
                   Arithmetic::mixed},
        ViolentRun{RollingModel::type_c, TangentialHistory::force, NormalDamping::with_tail,
                   Arithmetic::mixed},
        ViolentRun{RollingModel::type_c_undamped, TangentialHistory::displacement, NormalDamping::with_tail,
                   Arithmetic::mixed}));

}  // namespace
}  // namespace repose::test
