// The look that the sample takes at a heap must find what is wrong with it: a sound run, broken in one way
// each.

#include "stability/hostile/sample/hostile_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "unit/slump/tiny_scene.hpp"

namespace repose::hostile {
namespace {

/// What is found once `breaks` has been at a sound run; all in one line.
template <class Breaks>
std::string found(Breaks breaks) {
  static const Scene scene = test::sound_scene();
  static const RunResult sound = run_slump_test(scene, 1);
  RunResult result = sound;
  breaks(result);
  std::string text;
  for (const std::string& fault : faults_of(scene, result)) text += fault + "; ";
  return text;
}
bool says(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(HostileCheck, FindsNothingInASoundRun) {
  EXPECT_EQ(found([](RunResult& result) { ASSERT_EQ(result.outcome, Outcome::completed) << result.reason; }),
            "");
}

TEST(HostileCheck, FindsEachWayOfBeingBroken) {
  const double nan = std::nan("");
  EXPECT_TRUE(says(found([&](RunResult& r) { r.measurement.angle = nan; }), "angle"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.measurement.angle = -0.1; }), "angle"));
  EXPECT_TRUE(says(found([&](RunResult& r) { r.measurement.standard_error = nan; }), "standard error"));
  EXPECT_TRUE(says(found([&](RunResult& r) { r.measurement.flanks[2].angle = nan; }), "flank"));
  EXPECT_TRUE(says(found([&](RunResult& r) { r.energy.friction = nan; }), "ledger"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.energy.kinetic += 0.3 * r.energy.turnover; }), "ledger"));
  EXPECT_TRUE(says(found([](RunResult& r) {
                     for (auto& b : r.heap.bodies) b.velocity.x() = 0.1;
                   }),
                   "still move"));
  EXPECT_TRUE(says(found([](RunResult& r) {
                     r.heap.bodies[0].position = {0.0, 0.0, -1e-3};
                   }),
                   "under the base"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.heap.bodies[0].position.x() = 1e3; }), "a body is at"));
  EXPECT_TRUE(says(found([&](RunResult& r) { r.heap.bodies[0].position.x() = nan; }), "a body is at"));
  EXPECT_TRUE(
      says(found([](RunResult& r) { r.heap.spheres[0].centre = r.heap.spheres[1].centre; }), "an overlap"));
  EXPECT_TRUE(says(found([](RunResult& r) {
                     for (auto& s : r.heap.spheres) s.radius *= 1.1;
                   }),
                   "mean overlap"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.responses.mass_on_base *= 1.1; }), "mass on the base"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.responses.mass_lost += 0.1; }), "mass poured"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.responses.bulk_density = 2400.0; }), "solid fraction"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.responses.peak_height = 0.2; }), "heap of"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.outcome = Outcome::unstable; }), "no reason"));
  EXPECT_TRUE(says(found([](RunResult& r) { r.outcome = Outcome::interrupted, r.reason = "x"; }), "in time"));
}

}  // namespace
}  // namespace repose::hostile
