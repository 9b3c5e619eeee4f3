#include "engine/slump/shared_column.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

Scene sharing_scene(int count = 3) {
  Scene scene = tiny_scene();
  scene.test.filling = Filling::packing;
  scene.test.shared_columns = SharedColumns{.count = count};
  return scene;
}

/// The heap of a run, to be compared bit for bit.
std::vector<double> heap_of(const Scene& scene, std::uint64_t seed,
                            const std::shared_ptr<ColumnShelf>& shelf = nullptr) {
  RunOptions options;
  options.columns = shelf;
  SlumpTestRun run(scene, seed, options);
  run.run();
  EXPECT_EQ(run.outcome(), Outcome::completed) << run.reason();
  std::vector<double> numbers;
  for (const BodySnapshot& body : run.simulation().snapshot().bodies)
    numbers.insert(numbers.end(), {body.position.x(), body.position.y(), body.position.z(), body.scale});
  return numbers;
}

TEST(SharedColumn, GivesTheSameBitsWhoeverMadeIt) {
  const auto shelf = std::make_shared<ColumnShelf>();
  Scene other = sharing_scene();
  other.contact.particle_particle.static_friction = 0.9;
  heap_of(other, 1, shelf);  // makes column 1, for all
  const std::vector<double> alone = heap_of(sharing_scene(), 4);
  EXPECT_EQ(alone, heap_of(sharing_scene(), 4, shelf));
  EXPECT_EQ(alone, heap_of(sharing_scene(), 4, shelf));
}

TEST(SharedColumn, HoldsTheSameParticlesForAllItsRunsAndNoTwoAreTheSame) {
  const Scene scene = sharing_scene(3);
  const RunOptions options;
  const SlumpTestRun one(scene, 4, options), same(scene, 7, options), other(scene, 5, options);
  const auto masses = [](const SlumpTestRun& run) {
    std::vector<double> list;
    for (const ParticleDraw& particle : run.pour().particles()) list.push_back(particle.mass);
    return list;
  };
  EXPECT_EQ(masses(one), masses(same));
  EXPECT_EQ(number_of_column(*scene.test.shared_columns, 4), number_of_column(*scene.test.shared_columns, 7));
  EXPECT_NE(number_of_column(*scene.test.shared_columns, 4), number_of_column(*scene.test.shared_columns, 5));
  EXPECT_NE(heap_of(scene, 4), heap_of(scene, 7));
}

TEST(SharedColumn, IsMadeWithItsOwnContactWhateverTheRunsIs) {
  Scene scene = sharing_scene();
  scene.contact.particle_particle = {0.1, 0.9, 0.3};
  const Scene made = scene_of_column(scene);
  EXPECT_FALSE(made.test.shared_columns);
  EXPECT_EQ(made.contact.particle_particle.restitution, 0.3);
  EXPECT_EQ(made.contact.particle_particle.static_friction, 0.5);
  EXPECT_EQ(made.contact.particle_particle.rolling_friction, 0.1);
  EXPECT_EQ(made.contact.particle_wall.static_friction, scene.contact.particle_wall.static_friction);
}

TEST(SharedColumn, LeavesToTheRunWhatCountsAsCoarseForItsFriction) {
  Scene scene = sharing_scene();
  scene.contact.particle_particle.static_friction = 1.5;
  const RunOptions options;
  SlumpTestRun run(scene, 1, options);
  ASSERT_TRUE(run.fill()) << run.reason();
  EXPECT_EQ(run.diagnosis().coarse, MotionDiagnosis::kCoarseSticking);
}

// A turn about the axis leaves heights, distances from the axis and the distances of bodies as they were
// (tolerance: rounding of 30 mm).
TEST(SharedColumn, IsTurnedAsAWhole) {
  RandomStream random(3, 1);
  std::vector<NewBody> bodies(5);
  for (NewBody& body : bodies) {
    body.position = {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(0.0, 0.1)};
    body.orientation = random.rotation();
  }
  const std::vector<NewBody> result = turned(bodies, 2.1);
  const Vec3 tip(0.0, 0.0, 5e-3);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const NewBody &before = bodies[k], &after = result[k];
    EXPECT_EQ(after.position.z(), before.position.z());
    EXPECT_NEAR(std::atan2(after.position.y(), after.position.x()),
                std::remainder(std::atan2(before.position.y(), before.position.x()) + 2.1, 2.0 * kPi), 1e-14);
    const Vec3 tip_before = before.position + before.orientation * tip,
               tip_after = after.position + after.orientation * tip;
    EXPECT_NEAR((tip_after - result[0].position).norm(), (tip_before - bodies[0].position).norm(), 1e-16);
  }
}

/// From its filling on, the ledger of a run that takes a column counts what the column's springs hold. The
/// bodies settle again by little: they hold less than a hundredth of what a heap's fall turns over.
TEST(SharedColumn, BringsTheEnergyOfItsSpringsWithIt) {
  Scene scene = sharing_scene();
  scene.numerics.stiffness_scale = 1e-3;  // soft: the springs hold much
  scene.numerics.settle_energy_ratio = 1e-3;
  const RunOptions options;
  SlumpTestRun run(scene, 2, options);
  ASSERT_TRUE(run.fill()) << run.reason();
  const EnergyLedger ledger = run.simulation().ledger();
  EXPECT_GT(ledger.elastic_normal, 1e-4 * ledger.added);
  EXPECT_LT(std::abs(ledger.imbalance()), 0.2 * ledger.elastic_normal);
}

TEST(SharedColumn, SettlesAgainInLessTimeThanItTookToSettle) {
  const RunOptions options;
  const Scene scene = sharing_scene(), own = scene_of_column(scene);
  SlumpTestRun again(scene, 4, options), first(own, 1, options);
  ASSERT_TRUE(again.fill() && first.fill());
  EXPECT_LT(again.simulation().time(), 0.7 * first.simulation().time());
  EXPECT_EQ(again.column().bodies.size(), first.column().bodies.size());
}

TEST(SharedColumn, EndsTheRunWithItsOwnReasonWhereThereIsNone) {
  Scene scene = sharing_scene();
  scene.numerics.stage_time_limit = 1e-3;
  const RunOptions options;
  SlumpTestRun run(scene, 1, options);
  run.run();
  EXPECT_EQ(run.outcome(), Outcome::timed_out);
  EXPECT_EQ(run.reason().find("the shared column: "), 0U) << run.reason();
}

TEST(SharedColumn, CanBeInterruptedWhileItIsMade) {
  const std::atomic<bool> stop{true};
  RunOptions options;
  options.stop = &stop;
  options.columns = std::make_shared<ColumnShelf>();
  const Scene scene = sharing_scene();
  SlumpTestRun stopped(scene, 1, options);
  stopped.run();
  EXPECT_EQ(stopped.outcome(), Outcome::interrupted);
  EXPECT_EQ(stopped.reason(), "interrupted");
  options.stop = nullptr;
  SlumpTestRun again(scene, 1, options);
  again.run();
  EXPECT_EQ(again.outcome(), Outcome::completed) << again.reason();
}

TEST(ColumnShelf, MakesEachColumnOnceForAllWhoWantIt) {
  ColumnShelf shelf;
  std::atomic<int> made{0};
  const auto make = [&] {
    ++made;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return SharedColumn{};
  };
  std::vector<std::jthread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([&, k] { shelf.get(k % 2 == 0 ? "a" : "b", make); });
  threads.clear();
  EXPECT_EQ(made, 2);
}

TEST(ColumnShelf, KeepsNoneThatWasInterruptedAndAnyOther) {
  ColumnShelf shelf;
  int made = 0;
  const auto make = [&](Outcome outcome) {
    return [&made, outcome] {
      ++made;
      SharedColumn column;
      column.verdict.outcome = outcome;
      return column;
    };
  };
  shelf.get("a", make(Outcome::interrupted));
  EXPECT_EQ(shelf.get("a", make(Outcome::timed_out))->verdict.outcome, Outcome::timed_out);
  EXPECT_EQ(shelf.get("a", make(Outcome::completed))->verdict.outcome, Outcome::timed_out);
  EXPECT_EQ(made, 2);
}

TEST(ColumnShelf, LetsTheOldestGo) {
  ColumnShelf shelf;
  int made = 0;
  const auto make = [&made] {
    ++made;
    return SharedColumn{};
  };
  for (int k = 0; k < 300; ++k) shelf.get(std::to_string(k), make);
  EXPECT_EQ(made, 300);
  shelf.get("299", make);
  EXPECT_EQ(made, 300);
  shelf.get("0", make);
  EXPECT_EQ(made, 301);
}

}  // namespace
}  // namespace repose::test
