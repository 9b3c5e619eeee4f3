#include "engine/slump/slump_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <thread>

#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

/// Every number of a snapshot's bodies, to be compared bit for bit.
std::vector<double> numbers_of(const HeapSnapshot& heap) {
  std::vector<double> numbers;
  for (const BodySnapshot& b : heap.bodies) {
    for (const Vec3& v : {b.position, b.velocity, b.angular_velocity})
      numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
    numbers.insert(numbers.end(),
                   {b.orientation.w(), b.orientation.x(), b.orientation.y(), b.orientation.z(), b.mass});
  }
  return numbers;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class TinyRun {
 public:
  explicit TinyRun(Scene scene, std::uint64_t seed = 1, RunOptions options = {})
      : scene_(std::move(scene)), options_(std::move(options)), test_(scene_, seed, options_) {
    test_.run();
  }
  SlumpTestRun& operator*() { return test_; }
  SlumpTestRun* operator->() { return &test_; }

 private:
  Scene scene_;
  RunOptions options_;
  SlumpTestRun test_;
};

/// Of the bodies that lie on others; a stray that rolls for itself does not keep the heap from resting.
double largest_speed(const Simulation& simulation) {
  double speed = 0.0;
  const std::vector<char> touches = simulation.touching_another();
  for (std::size_t i = 0; i < simulation.bodies().count; ++i)
    if (touches[i]) speed = std::max(speed, simulation.bodies().velocity(i).norm());
  return speed;
}

class SlumpTestOf : public testing::TestWithParam<std::tuple<TestKind, RollingModel>> {};

TEST_P(SlumpTestOf, PoursSettlesOpensAndComesToRest) {
  Scene scene = tiny_scene(std::get<1>(GetParam()));
  scene.test.kind = std::get<0>(GetParam());
  scene.test.opening_speed = scene.test.kind == TestKind::split_cylinder ? 1.0 : 0.3;
  std::vector<std::string> stages;
  RunOptions options;
  options.on_progress = [&stages](const Progress& p) {
    if (stages.empty() || stages.back() != p.stage) stages.push_back(p.stage);
  };
  TinyRun run(scene, 1, options);
  ASSERT_EQ(run->outcome(), Outcome::completed) << run->reason();
  EXPECT_EQ(stages, (std::vector<std::string>{"pour", "settle", "open", "rest"}));

  // The settled column stands in the cylinder, whole; the heap is lower than it and stands on the base.
  const HeapSnapshot heap = run->simulation().snapshot();
  EXPECT_EQ(static_cast<int>(run->column().bodies.size()), run->pour().total_bodies());
  double column_top = 0.0, heap_top = 0.0;
  for (const SphereSnapshot& s : run->column().spheres) {
    column_top = std::max(column_top, s.centre.z() + s.radius);
    EXPECT_LT(std::hypot(s.centre.x(), s.centre.y()) + s.radius, 0.03 * 1.02);
    EXPECT_GT(s.centre.z() - s.radius, -0.0005);
  }
  for (const SphereSnapshot& s : heap.spheres) heap_top = std::max(heap_top, s.centre.z() + s.radius);
  EXPECT_LT(heap_top, 0.8 * column_top);
  EXPECT_GT(heap_top, 0.01);
  EXPECT_TRUE(heap.shells.empty());
  EXPECT_GT(run->rest_time(), 0.02);
  // At rest the mean energy is below 1e-5 m g d: of a hundred bodies none is faster than √(2 · 100 · 1e-5 g
  // d).
  EXPECT_LT(largest_speed(run->simulation()), std::sqrt(2.0 * 1e-3 * kGravity * 0.01));
}

INSTANTIATE_TEST_SUITE_P(
    KindsAndRollingModels, SlumpTestOf,
    testing::Combine(testing::Values(TestKind::split_cylinder, TestKind::lifted_cylinder),
                     testing::Values(RollingModel::type_a, RollingModel::type_a_relative,
                                     RollingModel::type_c, RollingModel::type_c_undamped)));

TEST(SlumpTestRun, GivesTheSameBitsTwiceAndInTwoThreadsAtOnce) {
  const Scene scene = tiny_scene();
  const auto numbers = [&scene](std::uint64_t seed) {
    TinyRun run(scene, seed);
    return numbers_of(run->simulation().snapshot());
  };
  const std::vector<double> first = numbers(5);
  EXPECT_TRUE(same_bits(first, numbers(5)));
  EXPECT_FALSE(same_bits(first, numbers(6)));
  std::vector<double> one, two;
  std::thread a([&] { one = numbers(5); }), b([&] { two = numbers(6); });
  a.join(), b.join();
  EXPECT_TRUE(same_bits(first, one));
  EXPECT_TRUE(same_bits(two, numbers(6)));
}

TEST(SlumpTestRun, DropsWhatLeavesTheBase) {
  // A base hardly wider than the cylinder and no friction: most bodies leave, none of those that are left
  // lies under the base's top, and what is left keeps its identity.
  Scene scene = tiny_scene();
  scene.test.base_radius = 0.035;
  scene.contact.particle_particle = scene.contact.particle_wall = {0.4, 0.1, 0.0};
  TinyRun run(scene);
  const Bodies& bodies = run->simulation().bodies();
  EXPECT_LT(static_cast<int>(bodies.count), run->pour().total_bodies() / 2);
  std::set<int> ids;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    EXPECT_GT(bodies.z[i] + bodies.reach[i], 0.0);
    ids.insert(bodies.id[i]);
  }
  EXPECT_EQ(ids.size(), bodies.count);
}

/// A cylinder that is gone at once touches nothing any more: it makes no difference how its parts would have
/// moved, and they do no work.
TEST(SlumpTestRun, AnInstantOpeningLeavesTheColumnToItself) {
  Scene scene = tiny_scene();
  scene.test.opening = Opening::instant;
  TinyRun split(scene);
  scene.test.kind = TestKind::lifted_cylinder;
  scene.test.opening_speed = 1e-6;  // would take longer than a test may
  TinyRun lifted(scene);
  ASSERT_EQ(split->outcome(), Outcome::completed) << split->reason();
  ASSERT_EQ(lifted->outcome(), Outcome::completed) << lifted->reason();
  EXPECT_TRUE(
      same_bits(numbers_of(split->simulation().snapshot()), numbers_of(lifted->simulation().snapshot())));
  EXPECT_EQ(split->simulation().ledger().wall_work, 0.0);
  EXPECT_LT(split->simulation().bodies().count, split->column().bodies.size());
}

TEST(SlumpTestRun, EndsOverfullWhereTheCylinderIsTooSmall) {
  Scene scene = tiny_scene();
  scene.particles.total_mass = 1.0;
  TinyRun run(scene);
  EXPECT_EQ(run->outcome(), Outcome::overfull);
  EXPECT_NE(run->reason().find("larger cylinder"), std::string::npos) << run->reason();
}

TEST(SlumpTestRun, EndsTimedOutWhereNothingComesToRestInTime) {
  Scene scene = tiny_scene();
  scene.numerics.stage_time_limit = 0.03;
  TinyRun run(scene);
  EXPECT_EQ(run->outcome(), Outcome::timed_out);
  EXPECT_NE(run->reason().find("rest"), std::string::npos) << run->reason();
}

TEST(SlumpTestRun, NeverCompletesWithAStepThatIsFarTooLarge) {
  for (const double fraction : {3.0, 10.0, 100.0, 1e4}) {
    Scene scene = tiny_scene();
    scene.numerics.time_step_fraction = fraction;
    TinyRun run(scene);
    EXPECT_TRUE(run->outcome() == Outcome::diverged || run->outcome() == Outcome::escaped)
        << fraction << " " << name_of(run->outcome());
    EXPECT_FALSE(run->reason().empty());
  }
}

TEST(SlumpTestRun, EndsInterruptedWhereItIsAskedTo) {
  std::atomic<bool> stop = false;
  RunOptions options;
  options.stop = &stop;
  options.on_progress = [&stop](const Progress& p) { stop = p.time > 0.05; };
  TinyRun run(tiny_scene(), 1, options);
  EXPECT_EQ(run->outcome(), Outcome::interrupted);
  EXPECT_LT(run->simulation().time(), 0.1);
}

TEST(SlumpTestRun, StandsOnAnUnboundedBase) {
  Scene scene = tiny_scene();
  scene.test.base_radius = std::numeric_limits<double>::infinity();
  TinyRun run(scene);
  EXPECT_EQ(run->outcome(), Outcome::completed) << run->reason();
  EXPECT_EQ(static_cast<int>(run->simulation().bodies().count), run->pour().total_bodies());
}

TEST(SlumpTestRun, ShowsFramesAndProgressInOrder) {
  std::vector<double> frames;
  std::vector<long> steps;
  double share = 0.0;
  RunOptions options;
  options.frame_interval = 0.05;
  options.on_frame = [&](const HeapSnapshot& heap) { frames.push_back(heap.time); };
  options.on_progress = [&](const Progress& p) {
    steps.push_back(p.steps);
    EXPECT_GE(p.expected_mass_share, share);
    share = p.expected_mass_share;
  };
  TinyRun run(tiny_scene(), 1, options);
  ASSERT_GT(frames.size(), 5U);
  for (std::size_t k = 1; k < frames.size(); ++k) EXPECT_NEAR(frames[k] - frames[k - 1], 0.05, 2e-3);
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  EXPECT_EQ(share, 1.0);
}

/// Three spheres, half a second apart: each finds room at once, and none waits meanwhile.
TEST(SlumpTestRun, APourSlowerThanOneParticleAQuarterSecondIsNotAFullCylinder) {
  Scene scene = tiny_scene();
  const double particle = 2500.0 * scene.particles.shapes[0].volume;
  scene.particles.total_mass = 3.0 * particle;
  scene.test.pour_rate = 2.0 * particle;
  TinyRun run(scene);
  EXPECT_NE(run->outcome(), Outcome::overfull) << run->reason();
  EXPECT_EQ(run->simulation().bodies().count, 3U);
}

TEST(SlumpTestRun, ATestOfMoreStepsThanARunMayTakeSaysSoAtOnce) {
  const auto outcome_of = [](auto change) {
    Scene scene = tiny_scene();
    change(scene);
    TinyRun run(scene);
    EXPECT_EQ(run->outcome(), Outcome::too_long) << run->reason();
    EXPECT_NE(run->reason().find("larger step"), std::string::npos) << run->reason();
    EXPECT_EQ(run->simulation().steps(), 0);
  };
  outcome_of([](Scene& scene) { scene.numerics.time_step_fraction = 1e-9; });
  outcome_of([](Scene& scene) { scene.numerics.time_step_fraction = 1e-320; });
  outcome_of([](Scene& scene) { scene.test.pour_rate = 1e-9; });
  outcome_of([](Scene& scene) { scene.test.opening_speed = 1e-9; });
  outcome_of([](Scene& scene) {
    scene.test.kind = TestKind::lifted_cylinder;
    scene.test.opening_speed = 1e-9;
  });
}

TEST(SlumpTestRun, IsInterruptedSoonHoweverSmallItsStep) {
  Scene scene = tiny_scene();
  scene.numerics.time_step_fraction = 1e-4;
  const std::atomic<bool> stop = true;
  RunOptions options;
  options.stop = &stop;
  TinyRun run(scene, 1, options);
  EXPECT_EQ(run->outcome(), Outcome::interrupted);
  EXPECT_EQ(run->simulation().steps(), 0);
}

}  // namespace
}  // namespace repose::test
