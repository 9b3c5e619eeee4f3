// Spheres of a body that come near a point, and pairs of them, against a look at every sphere in the world
// frame. Tolerance: 1e-15 m on places, some roundings of coordinates of up to a metre; a sphere within that
// of the limit may be found or not.

#include "engine/dynamics/reaching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/dynamics/place_sphere.hpp"
#include "support/test_scene.hpp"

namespace repose::test {
namespace {

constexpr double kClose = 1e-15;

/// Every sphere of a body in the world, from its turn and scale.
std::vector<Sphere> spheres_of(const NewBody& body, const Clump& shape) {
  std::vector<Sphere> spheres;
  for (const Sphere& local : shape.spheres)
    spheres.push_back(
        {body.position + body.scale * (body.orientation * local.centre), body.scale * local.radius});
  return spheres;
}

struct Placed {
  NewBody body;
  BodyAxes axes;

  Placed(RandomStream& random, int shape) {
    body.shape = shape;
    body.scale = random.uniform(0.5, 2.0);
    body.position = 0.02 * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform());
    body.orientation = random.rotation();
    axes = body_axes(body.position, body.orientation.toRotationMatrix(), body.scale);
  }
  [[nodiscard]] Reaching::Of as_numbered_from(std::size_t first) const {
    return {body.shape, axes, body.position, first};
  }
};

std::vector<Clump> some_shapes(RandomStream& random) {
  std::vector<Clump> shapes{sphere_clump(4e-3)};
  for (const int spheres : {2, 7, 8, 30}) shapes.push_back(random_clump(random, spheres, 5e-3));
  return shapes;
}

TEST(Reaching, FindsTheSpheresThatComeNearAPoint) {
  RandomStream random(1, 3);
  const std::vector<Clump> shapes = some_shapes(random);
  const LocalSpheres local(shapes);
  Reaching found;
  std::size_t all = 0, near = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Placed placed(random, trial % static_cast<int>(shapes.size()));
    const std::vector<Sphere> spheres =
        spheres_of(placed.body, shapes[static_cast<std::size_t>(placed.body.shape)]);
    const Vec3 point = placed.body.position + 8e-3 * (random.rotation() * Vec3::UnitX());
    const Vec3 origin(random.uniform(), random.uniform(), random.uniform());
    const double reach = random.uniform(0.0, 8e-3);
    found.find(local, placed.as_numbered_from(17), point, reach, origin);

    std::map<std::size_t, std::size_t> at;  // sphere → place among those found
    for (std::size_t k = 0; k < found.count; ++k) at[static_cast<std::size_t>(found.sphere[k]) - 17] = k;
    ASSERT_EQ(at.size(), found.count);
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      const double inside = spheres[s].radius + reach - (spheres[s].centre - point).norm();
      ++all;
      if (std::abs(inside) < kClose) continue;
      ASSERT_EQ(at.contains(s), inside > 0.0) << inside;
      if (inside < 0.0) continue;
      ++near;
      const std::size_t k = at[s];
      EXPECT_LT((Vec3(found.x[k], found.y[k], found.z[k]) + origin - spheres[s].centre).norm(), kClose);
      EXPECT_NEAR(found.radius[k], spheres[s].radius, kClose);
    }
    EXPECT_TRUE(std::is_sorted(found.sphere.begin(), found.sphere.begin() + static_cast<long>(found.count)));
  }
  EXPECT_GT(near, all / 10);
  EXPECT_LT(near, all - all / 10);
}

TEST(Reaching, VisitsTheNearPairsInOrder) {
  RandomStream random(2, 3);
  const std::vector<Clump> shapes = some_shapes(random);
  const LocalSpheres local(shapes);
  Reaching of_i, of_j;
  std::size_t seen = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const int shape = trial % static_cast<int>(shapes.size());
    const Placed i(random, shape);
    Placed j(random, 4);
    j.body.position = i.body.position + 9e-3 * (random.rotation() * Vec3::UnitX());
    j.axes = body_axes(j.body.position, j.body.orientation.toRotationMatrix(), j.body.scale);
    const double all = 1.0;  // the whole bodies reach into each other
    of_i.find(local, i.as_numbered_from(0), j.body.position, all, i.body.position);
    of_j.find(local, j.as_numbered_from(0), i.body.position, all, i.body.position);
    const std::vector<Sphere> a = spheres_of(i.body, shapes[static_cast<std::size_t>(shape)]),
                              b = spheres_of(j.body, shapes[4]);
    ASSERT_EQ(of_i.count, a.size());
    ASSERT_EQ(of_j.count, b.size());

    const double gap = 5e-4;
    std::vector<std::pair<std::size_t, std::size_t>> visited;
    for_each_near(of_i, of_j, gap, [&](std::size_t k, std::size_t l) { visited.emplace_back(k, l); });
    EXPECT_TRUE(std::ranges::is_sorted(visited));
    const std::set<std::pair<std::size_t, std::size_t>> found(visited.begin(), visited.end());
    ASSERT_EQ(found.size(), visited.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t l = 0; l < b.size(); ++l) {
        const double inside = a[k].radius + b[l].radius + gap - (a[k].centre - b[l].centre).norm();
        if (std::abs(inside) > kClose) {
          EXPECT_EQ(found.contains({k, l}), inside > 0.0);
        }
      }
    seen += visited.size();
  }
  EXPECT_GT(seen, 500U);
}

TEST(PlaceSphere, TurnsScalesAndMovesASphereOfItsShape) {
  RandomStream random(3, 3);
  const std::vector<Clump> shapes = some_shapes(random);
  const LocalSpheres local(shapes);
  for (int trial = 0; trial < 100; ++trial) {
    const Placed placed(random, trial % static_cast<int>(shapes.size()));
    const auto shape = static_cast<std::size_t>(placed.body.shape);
    const std::vector<Sphere> expected = spheres_of(placed.body, shapes[shape]);
    for (std::size_t s = 0; s < expected.size(); ++s) {
      PlacedSphere sphere;
      place_sphere(placed.axes, local.rows[static_cast<std::size_t>(local.first_row[shape]) + s], sphere);
      EXPECT_LT((Vec3(sphere.centre) - expected[s].centre).norm(), kClose);
      EXPECT_NEAR(sphere.radius, expected[s].radius, kClose);
    }
  }
}

}  // namespace
}  // namespace repose::test
