#include "engine/measure/heap_measurement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_heap.hpp"

namespace repose {
namespace {

using testing::HeapRecipe;
using testing::RandomPacking;
using testing::SyntheticHeap;

constexpr double kDiameter = 0.007;

void add_sphere_body(HeapSnapshot& heap, const Vec3& centre, double diameter = kDiameter) {
  BodySnapshot body;
  body.position = centre;
  body.volume = kPi / 6.0 * diameter * diameter * diameter;
  body.mass = 2500.0 * body.volume;
  heap.spheres.push_back({centre, 0.5 * diameter, static_cast<int>(heap.bodies.size())});
  heap.bodies.push_back(body);
}

/// A shell of spheres whose tops lie exactly on z = apex − √(t_x² x² + t_y² y²), spaced along a spiral.
HeapSnapshot exact_cone(double slope_x, double slope_y, double apex, double x0, double y0) {
  HeapSnapshot heap;
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < 4000; ++k) {
    const double r = 0.6 * kDiameter * std::sqrt(k + 0.5);
    const double x = r * std::cos(golden * k);
    const double y = r * std::sin(golden * k);
    const double z = apex - std::hypot(slope_x * x, slope_y * y);
    if (z > kDiameter) add_sphere_body(heap, {x0 + x, y0 + y, z - 0.5 * kDiameter});
  }
  return heap;
}

const RandomPacking& packing() {
  static const RandomPacking made(24.0, 12.0, 0.54, 0.15, 3);
  return made;
}

TEST(HeapMeasurement, ReadsAConeOfTopsExactly) {
  const HeapMeasurement measured = measure_heap(exact_cone(0.6, 0.6, 0.07, 0.0, 0.0));
  ASSERT_TRUE(measured.has_heap) << measured.reason;
  EXPECT_EQ(measured.reason, "");
  // No scatter: what remains is the step at which the fit ends, 1e-7 of a slope, and the axis's.
  EXPECT_NEAR(measured.angle, std::atan(0.6), 1e-5);
  for (const Flank& flank : measured.flanks) {
    EXPECT_NEAR(flank.angle, std::atan(0.6), 1e-5);
    EXPECT_NEAR(flank.z0, 0.07, 1e-6);
    EXPECT_LT(flank.standard_error, 1e-4);
  }
  EXPECT_NEAR(measured.peak_height, 0.07, 0.6 * kDiameter);
}

TEST(HeapMeasurement, ReadsAStretchedConeOffTheCentreExactly) {
  const HeapMeasurement measured = measure_heap(exact_cone(0.45, 0.7, 0.08, 0.012, -0.02));
  ASSERT_TRUE(measured.has_heap) << measured.reason;
  EXPECT_NEAR(measured.flanks[0].angle, std::atan(0.45), 1e-5);
  EXPECT_NEAR(measured.flanks[1].angle, std::atan(0.45), 1e-5);
  EXPECT_NEAR(measured.flanks[2].angle, std::atan(0.7), 1e-5);
  EXPECT_NEAR(measured.flanks[3].angle, std::atan(0.7), 1e-5);
  EXPECT_NEAR(measured.axis_x, 0.012, 1e-5);
  EXPECT_NEAR(measured.axis_y, -0.02, 1e-5);
}

TEST(HeapMeasurement, TheAngleIsTheMeanOfFourFlanks) {
  HeapRecipe recipe;
  recipe.stretch = 1.2;
  const HeapMeasurement measured = measure_heap(SyntheticHeap(packing(), recipe).snapshot);
  ASSERT_TRUE(measured.has_heap);
  double mean = 0.0;
  for (const Flank& flank : measured.flanks) mean += 0.25 * flank.angle;
  EXPECT_DOUBLE_EQ(measured.angle, mean);
}

TEST(HeapMeasurement, TheWindowIsThatOfTheOptions) {
  HeapRecipe recipe;
  recipe.apex_height = 0.07;
  const HeapSnapshot heap = SyntheticHeap(packing(), recipe).snapshot;
  MeasureOptions options;
  options.window_low = 0.35;
  options.window_high = 0.7;
  const HeapMeasurement measured = measure_heap(heap, options);
  ASSERT_TRUE(measured.has_heap);
  for (const Flank& flank : measured.flanks) {
    const auto line = [&](double r) { return flank.z0 - std::tan(flank.angle) * r; };
    // The ends are the outermost tops inside the window: within a diameter of its limits, and beyond by no
    // more than the last fit moved the lines, a few hundredths of a diameter.
    EXPECT_LE(line(flank.r_begin), 0.7 * measured.peak_height + 0.05 * kDiameter);
    EXPECT_GT(line(flank.r_begin), 0.7 * measured.peak_height - kDiameter);
    EXPECT_GE(line(flank.r_end), 0.35 * measured.peak_height - 0.05 * kDiameter);
    EXPECT_LT(line(flank.r_end), 0.35 * measured.peak_height + kDiameter);
  }
}

TEST(HeapMeasurement, TheFlankEndsADiameterInsideTheEdgeOfTheBase) {
  HeapRecipe recipe;
  recipe.apex_height = 0.07;
  recipe.base_radius = 0.085;
  const HeapMeasurement measured = measure_heap(SyntheticHeap(packing(), recipe).snapshot);
  ASSERT_TRUE(measured.has_heap);
  for (const Flank& flank : measured.flanks) EXPECT_LT(flank.r_end, 0.085 - 0.9 * kDiameter + 1e-3);
}

TEST(HeapMeasurement, TheProfileScattersAboutTheLine) {
  const HeapMeasurement measured = measure_heap(SyntheticHeap(packing(), {}).snapshot);
  ASSERT_TRUE(measured.has_heap);
  for (const Flank& flank : measured.flanks) {
    int near = 0;
    int inside = 0;
    for (const ProfilePoint& p : flank.profile) {
      if (p.r < flank.r_begin || p.r > flank.r_end) continue;
      ++inside;
      if (std::abs(p.z - flank.z0 + std::tan(flank.angle) * p.r) < kDiameter) ++near;
    }
    EXPECT_GT(inside, 20);
    EXPECT_GT(near, 0.95 * inside);
  }
}

TEST(HeapMeasurement, IsTheSameBitForBitWhenRepeated) {
  const HeapSnapshot heap = SyntheticHeap(packing(), {}).snapshot;
  const HeapMeasurement a = measure_heap(heap);
  const HeapMeasurement b = measure_heap(heap);
  EXPECT_EQ(a.angle, b.angle);
  EXPECT_EQ(a.standard_error, b.standard_error);
}

TEST(HeapMeasurement, AQuarterTurnExchangesTheFlanks) {
  HeapRecipe recipe;
  recipe.stretch = 1.25;
  HeapSnapshot heap = SyntheticHeap(packing(), recipe).snapshot;
  const HeapMeasurement straight = measure_heap(heap);
  for (BodySnapshot& body : heap.bodies)
    body.position = Vec3(-body.position.y(), body.position.x(), body.position.z());
  for (SphereSnapshot& s : heap.spheres) s.centre = Vec3(-s.centre.y(), s.centre.x(), s.centre.z());
  const HeapMeasurement turned = measure_heap(heap);
  // +x → +y, −x → −y, +y → −x, −y → +x. Sums run in another order, and tops on a diagonal change their
  // quarter.
  EXPECT_NEAR(turned.flanks[2].angle, straight.flanks[0].angle, 1e-6);
  EXPECT_NEAR(turned.flanks[3].angle, straight.flanks[1].angle, 1e-6);
  EXPECT_NEAR(turned.flanks[1].angle, straight.flanks[2].angle, 1e-6);
  EXPECT_NEAR(turned.flanks[0].angle, straight.flanks[3].angle, 1e-6);
  EXPECT_NEAR(turned.standard_error, straight.standard_error, 1e-5);
}

/// The cone z = 70 mm − 0.6 r meets the base at r = 117 mm.
TEST(HeapMeasurement, SaysWhetherTheEdgeCutsTheHeap) {
  HeapSnapshot heap = exact_cone(0.6, 0.6, 0.07, 0.0, 0.0);
  heap.base_radius = 0.0975;
  EXPECT_TRUE(measure_heap(heap).reaches_edge);
  heap.base_radius = 0.2;
  EXPECT_FALSE(measure_heap(heap).reaches_edge);
  heap.base_radius = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(measure_heap(heap).reaches_edge);
}

TEST(HeapMeasurement, StraysChangeNothing) {
  HeapRecipe recipe;
  const HeapMeasurement clean = measure_heap(SyntheticHeap(packing(), recipe).snapshot);
  HeapSnapshot heap = SyntheticHeap(packing(), recipe).snapshot;
  RandomStream random(4, 0);
  for (int k = 0; k < 30; ++k) {
    const double phi = random.uniform(0.0, 2.0 * kPi);
    const double r = random.uniform(0.11, 0.3);
    add_sphere_body(heap, {r * std::cos(phi), r * std::sin(phi), 0.5 * kDiameter});
  }
  add_sphere_body(heap, {0.01, 0.0, 0.2});
  const HeapMeasurement strewn = measure_heap(heap);
  EXPECT_EQ(strewn.angle, clean.angle);
  EXPECT_EQ(strewn.peak_height, clean.peak_height);
  EXPECT_GT(strewn.mass_on_base, clean.mass_on_base);
}

TEST(HeapMeasurement, MassOnBaseLeavesOutWhatIsBeyondTheEdgeOrBelowTheTop) {
  HeapSnapshot heap;
  heap.base_radius = 0.1;
  add_sphere_body(heap, {0.0, 0.0, 0.0035});
  add_sphere_body(heap, {0.0999, 0.0, 0.0035});
  add_sphere_body(heap, {0.1001, 0.0, 0.0035});
  add_sphere_body(heap, {0.0, 0.05, -0.001});
  EXPECT_DOUBLE_EQ(measure_heap(heap).mass_on_base, 2.0 * heap.bodies[0].mass);
}

void expect_no_heap(const HeapSnapshot& heap, const std::string& reason) {
  const HeapMeasurement measured = measure_heap(heap);
  EXPECT_FALSE(measured.has_heap);
  EXPECT_NE(measured.reason.find(reason), std::string::npos) << measured.reason;
}

TEST(NoHeap, NothingOnTheBase) {
  expect_no_heap({}, "nothing rests on the base");
  HeapSnapshot below;
  add_sphere_body(below, {0.0, 0.0, -0.03});
  expect_no_heap(below, "nothing rests on the base");
}

TEST(NoHeap, AFewBodies) {
  HeapSnapshot heap;
  for (int k = 0; k < 7; ++k) add_sphere_body(heap, {k * kDiameter, 0.0, 0.5 * kDiameter});
  expect_no_heap(heap, "only 7 bodies");
}

TEST(NoHeap, StraysAlone) {
  HeapSnapshot heap;
  for (int k = 0; k < 60; ++k) add_sphere_body(heap, {3.0 * k * kDiameter, 0.0, 0.5 * kDiameter});
  expect_no_heap(heap, "only 1 bodies");
}

TEST(NoHeap, OneLayer) {
  HeapSnapshot heap;
  for (int j = -8; j <= 8; ++j) {
    for (int i = -8; i <= 8; ++i) add_sphere_body(heap, {i * kDiameter, j * kDiameter, 0.5 * kDiameter});
  }
  expect_no_heap(heap, "one layer");
  EXPECT_FALSE(measure_heap(heap).unreadable) << "there is no heap, however it were read";
}

TEST(NoHeap, ALevelBed) {
  HeapSnapshot heap;
  for (const testing::PackedSphere& s : packing().spheres()) {
    const Vec3 centre = kDiameter * (s.centre - Vec3(12.0, 12.0, 0.0));
    if (s.centre.z() < 5.0 && std::hypot(centre.x(), centre.y()) < 0.08) {
      add_sphere_body(heap, centre, 2.0 * kDiameter * s.radius);
    }
  }
  heap.base_radius = 0.08;
  EXPECT_FALSE(measure_heap(heap).has_heap) << degrees(measure_heap(heap).angle);
}

TEST(NoHeap, AFlankThatTheEdgeCutsAway) {
  HeapRecipe recipe;
  HeapSnapshot heap = SyntheticHeap(packing(), recipe).snapshot;
  // The apex stands over the edge of the base: there is no flank along +x.
  HeapSnapshot cut;
  for (const SphereSnapshot& s : heap.spheres) {
    if (s.centre.x() < 0.0) add_sphere_body(cut, s.centre + Vec3(0.0975, 0.0, 0.0), 2.0 * s.radius);
  }
  cut.base_radius = 0.0975;
  expect_no_heap(cut, "flank +x");
  EXPECT_TRUE(measure_heap(cut).unreadable);
}

TEST(NoHeap, APositionThatIsNotANumber) {
  HeapSnapshot heap = exact_cone(0.6, 0.6, 0.07, 0.0, 0.0);
  heap.spheres[5].centre.z() = std::nan("");
  expect_no_heap(heap, "not a finite number");
}

TEST(HeapMeasurement, AFlatHeapIsReadAndFlagged) {
  HeapRecipe recipe;
  recipe.angle = radians(8.0);
  recipe.apex_height = 2.8 * kDiameter;
  const SyntheticHeap heap(packing(), recipe);
  const HeapMeasurement measured = measure_heap(heap.snapshot);
  ASSERT_TRUE(measured.has_heap) << measured.reason;
  ASSERT_FALSE(measured.warnings.empty());
  EXPECT_EQ(measured.warnings[0].name, "flat_heap");
  EXPECT_NE(measured.warnings[0].text.find("body diameters high"), std::string::npos)
      << measured.warnings[0].text;
  EXPECT_NEAR(degrees(measured.angle), 8.0, 1.0);
}

TEST(HeapMeasurement, AStandingColumnIsNeverAQuietAngle) {
  HeapSnapshot heap;
  for (const testing::PackedSphere& s : packing().spheres()) {
    const Vec3 centre = kDiameter * (s.centre - Vec3(12.0, 12.0, 0.0));
    if (std::hypot(centre.x(), centre.y()) < 0.03) add_sphere_body(heap, centre, 2.0 * kDiameter * s.radius);
  }
  const HeapMeasurement measured = measure_heap(heap);
  EXPECT_FALSE(measured.has_heap && measured.warnings.empty()) << degrees(measured.angle);
}

// A column as it stood in its cylinder, its top a cone of 36°: what falls by that is the top and no slope of
// a heap.
TEST(HeapMeasurement, TheTopOfAStandingColumnIsNoFlank) {
  HeapSnapshot heap;
  for (const testing::PackedSphere& s : packing().spheres()) {
    const Vec3 centre = kDiameter * (s.centre - Vec3(12.0, 12.0, 0.0));
    const double r = std::hypot(centre.x(), centre.y());
    if (r < 0.035 && centre.z() < 0.075 - std::tan(radians(36.0)) * r)
      add_sphere_body(heap, centre, 2.0 * kDiameter * s.radius);
  }
  heap.base_radius = 0.07;
  const HeapMeasurement measured = measure_heap(heap);
  EXPECT_FALSE(measured.has_heap) << degrees(measured.angle);
  EXPECT_TRUE(measured.unreadable);
  EXPECT_NE(measured.reason.find("may still stand"), std::string::npos) << measured.reason;
}

TEST(HeapMeasurement, SizesOfARatioOfTenDoNotHurt) {
  HeapSnapshot heap = exact_cone(0.6, 0.6, 0.07, 0.0, 0.0);
  RandomStream random(8, 0);
  for (int k = 0; k < 3000; ++k) {
    const double x = random.uniform(-0.08, 0.08);
    const double y = random.uniform(-0.08, 0.08);
    const double surface = 0.07 - 0.6 * std::hypot(x, y);
    if (surface > 0.01) add_sphere_body(heap, {x, y, random.uniform(0.0, 0.8) * surface}, 0.1 * kDiameter);
  }
  const HeapMeasurement measured = measure_heap(heap);
  ASSERT_TRUE(measured.has_heap) << measured.reason;
  EXPECT_NEAR(degrees(measured.angle), degrees(std::atan(0.6)), 0.5);
}

}  // namespace
}  // namespace repose
