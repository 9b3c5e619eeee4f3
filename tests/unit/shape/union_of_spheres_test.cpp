#include "engine/shape/union_of_spheres.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"

namespace repose {
namespace {

std::vector<Sphere> cluster(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<Sphere> spheres(count);
  for (Sphere& sphere : spheres) {
    sphere.centre = 0.7 * Vec3(random.normal(), random.normal(), random.normal());
    sphere.radius = random.uniform(0.3, 1.0);
  }
  return spheres;
}

TEST(UnionOfSpheres, OfOneSphereIsTheSphere) {
  const Vec3 c(0.3, -0.2, 0.5);
  const double r = 0.8;
  const UnionOfSpheres ball = unite(std::vector<Sphere>{{c, r}}, 20);
  const MassProperties body = mass_properties(ball.moments);
  const double volume = 4.0 / 3.0 * kPi * r * r * r;
  // Polynomials in z of degree 4: three-point Gauss is exact, what remains is rounding.
  EXPECT_NEAR(body.volume, volume, 1e-13);
  EXPECT_NEAR((body.centre - c).norm(), 0.0, 1e-13);
  EXPECT_NEAR((body.inertia - 0.4 * volume * r * r * Mat3::Identity()).norm(), 0.0, 1e-13);
  EXPECT_NEAR(ball.area, 4.0 * kPi * r * r, 1e-12);
}

TEST(UnionOfSpheres, OfTwoSpheresIsTheirSumLessTheLens) {
  // Lens of two spheres R, r at distance d: π (R+r−d)² (d² + 2d(R+r) − 3(R−r)²) / (12 d).
  const double R = 1.0;
  const double r = 0.6;
  const double d = 0.9;
  const double lens =
      kPi * std::pow(R + r - d, 2) * (d * d + 2 * d * (R + r) - 3 * (R - r) * (R - r)) / (12 * d);
  const double expected = 4.0 / 3.0 * kPi * (R * R * R + r * r * r) - lens;
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.6, 0.0, 0.8), Vec3(0.48, 0.6, 0.64)}) {
    const std::vector<Sphere> pair = {{Vec3::Zero(), R}, {d * axis, r}};
    EXPECT_NEAR(unite(pair, 100).moments[0] / expected, 1.0, 1e-5) << axis.transpose();
    EXPECT_NEAR(unite(pair, 1000).moments[0] / expected, 1.0, 1e-7) << axis.transpose();
  }
}

TEST(UnionOfSpheres, DoesNotDependOnTheDirectionOfTheCuts) {
  const std::vector<Sphere> spheres = cluster(30, 5);
  const MassProperties body = mass_properties(unite(spheres, 200).moments);
  RandomStream random(9, 0);
  for (int turn = 0; turn < 5; ++turn) {
    const Mat3 rotation = random.rotation().toRotationMatrix();
    std::vector<Sphere> turned = spheres;
    for (Sphere& sphere : turned) sphere.centre = rotation * sphere.centre;
    const MassProperties other = mass_properties(unite(turned, 200).moments);
    EXPECT_NEAR(other.volume / body.volume, 1.0, 2e-6);
    EXPECT_LT((other.centre - rotation * body.centre).norm(), 2e-6);
    EXPECT_LT((other.inertia - rotation * body.inertia * rotation.transpose()).norm() / body.inertia.norm(),
              4e-6);
  }
}

TEST(UnionOfSpheres, AgreesWithCountingRandomPoints) {
  const std::vector<Sphere> spheres = cluster(12, 3);
  RandomStream random(1, 2);
  const double half = 4.0;
  const int count = 400000;
  int inside = 0;
  double zz = 0.0;
  for (int i = 0; i < count; ++i) {
    const Vec3 p(random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half));
    for (const Sphere& sphere : spheres) {
      if ((p - sphere.centre).squaredNorm() < sphere.radius * sphere.radius) {
        ++inside;
        zz += p.z() * p.z();
        break;
      }
    }
  }
  const double box = std::pow(2 * half, 3);
  const double share = static_cast<double>(inside) / count;
  const Moments moments = unite(spheres, 100).moments;
  // Four standard deviations of the count; z² ≤ 16 in the box, in the cluster about 1.
  EXPECT_NEAR(moments[0], box * share, 4 * box * std::sqrt(share / count));
  EXPECT_NEAR(moments[6], box * zz / count, 4 * box * 2.0 * std::sqrt(share / count));
}

TEST(UnionOfSpheres, CountsASphereInsideAnotherAndATwinOnce) {
  const std::vector<Sphere> spheres = {
      {Vec3::Zero(), 1.0}, {Vec3(0.2, 0.1, 0.0), 0.5}, {Vec3::Zero(), 1.0}, {Vec3(5, 0, 0), 0.1}};
  const UnionOfSpheres both = unite(spheres, 50);
  EXPECT_NEAR(both.moments[0], 4.0 / 3.0 * kPi * 1.001, 1e-12);
  EXPECT_EQ(both.exposed[1], 0.0);
  EXPECT_NEAR(both.exposed[0], 4.0 * kPi, 1e-12);
  EXPECT_EQ(both.exposed[2], 0.0);
}

TEST(UnionOfSpheres, GradientIsThatOfTheMoments) {
  std::vector<Sphere> spheres = cluster(8, 11);
  const UnionOfSpheres at = unite(spheres, 800, true);
  const double step = 1e-3;
  for (Eigen::Index i = 0; i < 4 * 8; ++i) {
    Sphere& sphere = spheres[static_cast<std::size_t>(i / 4)];
    double& value = i % 4 == 3 ? sphere.radius : sphere.centre[i % 4];
    const double middle = value;
    value = middle + step;
    const Moments high = unite(spheres, 800).moments;
    value = middle - step;
    const Moments low = unite(spheres, 800).moments;
    value = middle;
    // Central differences err by step²; the quadrature's error, below 1e-6, is divided by the step.
    const Moments slope = at.gradient.col(i);
    EXPECT_LT(((high - low) / (2 * step) - slope).cwiseAbs().maxCoeff(), 5e-4 * slope.cwiseAbs().maxCoeff())
        << "parameter " << i;
  }
}

}  // namespace
}  // namespace repose
