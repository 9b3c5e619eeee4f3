// What a Tether allows, against the distances between all spheres of two bodies that fly freely.

#include "engine/dynamics/tether.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/dynamics/integrate.hpp"
#include "support/test_scene.hpp"

namespace repose::test {
namespace {

constexpr BodyPair kPair{1, 0};
constexpr MotionStep kStep{.dt = 1e-4};

Vec3 random_vector(RandomStream& random, double size) {
  return size * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
}

/// Two clumps that fly at a common velocity, each with one of its own, and turn.
Bodies two_bodies(RandomStream& random, const Vec3& common, double own, double spin) {
  const std::vector<Clump> shapes{random_clump(random, 8, 5e-3)};
  Bodies bodies(shapes, 2500.0);
  for (int k = 0; k < 2; ++k) {
    NewBody body;
    body.position = Vec3(0.3, 0.02 * k, 0.5) + random_vector(random, 2e-3);
    body.orientation = random.rotation();
    body.velocity = common + random_vector(random, own);
    body.angular_velocity = random_vector(random, spin);
    bodies.add(body);
  }
  return bodies;
}

/// Distances between the centres of spheres, each of one body with each of the other [m].
std::vector<double> distances(const Bodies& bodies) {
  const auto centre = [&](std::size_t i, const Sphere& local) {
    return Vec3(bodies.position(i) + bodies.orientation(i) * local.centre);
  };
  std::vector<double> all;
  for (const Sphere& a : bodies.spheres(0))
    for (const Sphere& b : bodies.spheres(1)) all.push_back((centre(0, a) - centre(1, b)).norm());
  return all;
}

bool holds(const Tether& tether, const Bodies& bodies, double further) {
  const std::vector<TetherEnd> ends{{bodies, 0, further}, {bodies, 1, 0.0}};
  bool let_go = false;
  for_each_let_go({&tether, 1}, {&kPair, 1}, ends, [&](std::size_t) { let_go = true; });
  return !let_go;
}

TEST(Tether, HoldsOnlyWhileNoTwoSpheresHaveComeNearerThanItsSlack) {
  RandomStream random(1, 21);
  int held = 0, let_go = 0;
  double most_used = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    Bodies bodies = two_bodies(random, random_vector(random, 1.0), 0.3, trial % 2 == 0 ? 0.0 : 60.0);
    const double slack = 1e-3;
    const Tether tether(bodies, kPair, slack);
    const std::vector<double> before = distances(bodies);
    for (int step = 0; step < 200; ++step) {
      integrate(bodies, kStep);
      if (!holds(tether, bodies, 0.0)) {
        ++let_go;
        break;
      }
      ++held;
      const std::vector<double> now = distances(bodies);
      for (std::size_t k = 0; k < now.size(); ++k) {
        ASSERT_GE(now[k], before[k] - slack) << "trial " << trial << " step " << step;
        most_used = std::max(most_used, (before[k] - now[k]) / slack);
      }
    }
  }
  EXPECT_GT(held, 1000);
  EXPECT_GT(let_go, 150);
  EXPECT_GT(most_used, 0.9);  // spheres that head straight for each other use nearly all of it
}

TEST(Tether, HoldsForGoodWhereBothBodiesGoTheSameWay) {
  RandomStream random(2, 21);
  Bodies bodies = two_bodies(random, Vec3(1.0, -0.5, 3.0), 0.0, 0.0);
  const Tether tether(bodies, kPair, 1e-7);  // four times what floats round off at 2 cm
  for (int step = 0; step < 10000; ++step) integrate(bodies, kStep);
  EXPECT_GT(bodies.travel[0], 1.0);
  EXPECT_TRUE(holds(tether, bodies, 0.0));
}

TEST(Tether, ReservesWhatItIsAskedFor) {
  RandomStream random(3, 21);
  const Bodies bodies = two_bodies(random, Vec3::Zero(), 0.0, 0.0);
  const Tether tether(bodies, kPair, 1e-3);
  EXPECT_TRUE(holds(tether, bodies, 0.99e-3));
  EXPECT_FALSE(holds(tether, bodies, 1e-3));  // a float does not tell it from more
  EXPECT_FALSE(holds(Tether(), bodies, 0.0));
  EXPECT_TRUE(holds(Tether::endless(), bodies, 1.0));
}

/// |Δ apart| + Δ swung + what is reserved, in doubles and pair by pair. Floats round off 1e-7 of what is up
/// to 3 m here, so that a pair within 1e-6 m of its slack may be told either way.
TEST(Tether, RowsOfAnyLengthLetGoAsTheirPairsDo) {
  RandomStream random(4, 21);
  const std::vector<Clump> shapes{random_clump(random, 8, 5e-3)};
  Bodies bodies(shapes, 2500.0);
  for (int k = 0; k < 12; ++k) {
    NewBody body;
    body.position = random_vector(random, 1.0), body.velocity = random_vector(random, 1.0);
    body.angular_velocity = random_vector(random, 30.0);
    bodies.add(body);
  }
  const Bodies then = bodies;
  integrate(bodies, kStep);
  std::vector<TetherEnd> ends;
  std::vector<double> further;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    further.push_back(random.uniform(0.0, 1e-4));
    ends.emplace_back(bodies, i, further.back());
  }
  int let_go = 0;
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<BodyPair> pairs;
    std::vector<Tether> tethers;
    std::vector<double> left;
    for (std::size_t p = 0; p < n; ++p) {
      const int i = 1 + static_cast<int>(11.0 * random.uniform()), j = static_cast<int>(i * random.uniform());
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      pairs.push_back({i, j});
      const double slack = random.uniform(0.0, 8e-4);
      tethers.emplace_back(then, pairs.back(), slack);
      const Vec3 moved = bodies.position(a) - bodies.position(b) - (then.position(a) - then.position(b));
      left.push_back(slack - moved.norm() - (bodies.swung[a] - then.swung[a]) -
                     (bodies.swung[b] - then.swung[b]) - further[a] - further[b]);
    }
    std::vector<char> lets_go(n, 0);
    for_each_let_go(tethers, pairs, ends, [&](std::size_t p) { lets_go[p] = 1; });
    for (std::size_t p = 0; p < n; ++p) {
      let_go += lets_go[p];
      if (std::abs(left[p]) > 1e-6) {
        ASSERT_EQ(lets_go[p] != 0, left[p] < 0.0) << p << " of " << n;
      }
    }
  }
  EXPECT_GT(let_go, 200);
  EXPECT_LT(let_go, 600);
}

}  // namespace
}  // namespace repose::test
