#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.hpp"
#include "engine/measure/heap_measurement.hpp"

namespace repose {
namespace {

constexpr double kDensity = 2500.0;

void add_dense_sphere(HeapSnapshot& column, const Vec3& centre, double radius) {
  BodySnapshot body;
  body.position = centre;
  body.volume = 4.0 / 3.0 * kPi * radius * radius * radius;
  body.mass = kDensity * body.volume;
  column.spheres.push_back({centre, radius, static_cast<int>(column.bodies.size())});
  column.bodies.push_back(body);
}

/// A simple cubic stack: layers of n × n spheres of radius r.
HeapSnapshot cubic_stack(int n, int layers, double r) {
  HeapSnapshot column;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        add_dense_sphere(column, {(2 * i - n + 1) * r, (2 * j - n + 1) * r, (2 * k + 1) * r}, r);
      }
    }
  }
  return column;
}

TEST(ColumnDensity, IsExactForAStackWhoseSlabEndsBetweenLayers) {
  // Ten layers: the slab from 10 % to 80 % of the height holds the layers 2 … 8 whole.
  const double r = 0.004;
  const double radius = 0.05;
  const double mass = 7 * 16 * kDensity * 4.0 / 3.0 * kPi * r * r * r;
  const double volume = kPi * radius * radius * 14.0 * r;
  EXPECT_NEAR(column_bulk_density(cubic_stack(4, 10, r), radius) / (mass / volume), 1.0, 1e-12);
}

TEST(ColumnDensity, CutsSpheresAtTheSlabsEnds) {
  // Three layers of height 6 r: the slab from 0.6 r to 4.8 r. By Cavalieri, a cap of height h has volume
  // π h² (3 r − h)/3: the first layer loses a cap of 0.6 r, the third keeps one of 0.8 r.
  const double r = 0.004;
  const double radius = 0.03;
  const auto cap = [&](double h) { return kPi * h * h * (3.0 * r - h) / 3.0; };
  const double whole = 4.0 / 3.0 * kPi * r * r * r;
  const double mass = 9 * kDensity * (2.0 * whole - cap(0.6 * r) + cap(0.8 * r));
  const double volume = kPi * radius * radius * 4.2 * r;
  EXPECT_NEAR(column_bulk_density(cubic_stack(3, 3, r), radius) / (mass / volume), 1.0, 1e-12);
}

TEST(ColumnDensity, CountsTheMassOfABodyOnceWhereItsSpheresOverlap) {
  // Every sphere of a stack is replaced by two that coincide, and the body keeps its mass.
  HeapSnapshot column = cubic_stack(3, 7, 0.004);
  const double once = column_bulk_density(column, 0.03);
  const std::vector<SphereSnapshot> spheres = column.spheres;
  column.spheres.clear();
  for (const SphereSnapshot& sphere : spheres) {
    column.spheres.push_back(sphere);
    column.spheres.push_back(sphere);
  }
  EXPECT_NEAR(column_bulk_density(column, 0.03) / once, 1.0, 1e-12);
}

/// Volume of a sphere between two heights by Simpson's rule over its discs; exact for the cubic
/// antiderivative.
double disc_quadrature(double radius, double centre, double low, double high) {
  const double a = std::max(low, centre - radius);
  const double b = std::min(high, centre + radius);
  if (b <= a) return 0.0;
  const auto disc = [&](double z) { return kPi * (radius * radius - (z - centre) * (z - centre)); };
  return (b - a) / 6.0 * (disc(a) + 4.0 * disc(0.5 * (a + b)) + disc(b));
}

TEST(ColumnDensity, AgreesWithAQuadratureOverDiscsForVariedSpheres) {
  RandomStream random(11, 0);
  HeapSnapshot column;
  for (int k = 0; k < 40; ++k) {
    for (int j = 0; j < 5; ++j) {
      const double r = random.uniform(0.002, 0.004);
      add_dense_sphere(column, {0.008 * (j - 2), random.uniform(-0.001, 0.001), 0.004 + 0.0065 * k}, r);
    }
  }
  // A level top: five equal spheres whose highest point is the column's height, 0.268 m.
  for (int j = 0; j < 5; ++j) add_dense_sphere(column, {0.008 * (j - 2), 0.0, 0.264}, 0.004);
  double mass = 0.0;
  for (const SphereSnapshot& s : column.spheres) {
    mass += kDensity * disc_quadrature(s.radius, s.centre.z(), 0.0268, 0.2144);
  }
  const double expected = mass / (kPi * 0.05 * 0.05 * 0.1876);
  EXPECT_NEAR(column_bulk_density(column, 0.05) / expected, 1.0, 1e-6);
}

TEST(ColumnDensity, ABodyInTheAirOrOneOnTopDoesNotMoveTheSlab) {
  HeapSnapshot column = cubic_stack(6, 10, 0.004);
  const double undisturbed = column_bulk_density(column, 0.05);
  add_dense_sphere(column, {0.0, 0.0, 0.2}, 0.004);
  add_dense_sphere(column, {0.004, 0.004, 0.084}, 0.004);
  EXPECT_NEAR(column_bulk_density(column, 0.05), undisturbed, 1e-9 * undisturbed);
}

TEST(ColumnDensity, IsZeroForAnEmptyColumn) { EXPECT_EQ(column_bulk_density({}, 0.05), 0.0); }

TEST(ColumnDensity, IsZeroForAPositionThatIsNotANumber) {
  HeapSnapshot column = cubic_stack(3, 3, 0.004);
  column.bodies[0].position.x() = std::nan("");
  EXPECT_EQ(column_bulk_density(column, 0.05), 0.0);
}

}  // namespace
}  // namespace repose
