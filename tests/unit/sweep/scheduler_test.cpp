// In which order runs are made, by whom, and what is said of them meanwhile.

#include "sweep/scheduler.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "sweep/sweep.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

TEST_F(SweepTest, MakesReplicateByReplicateTheLongestRunsFirst) {
  const Json sweep = {{"design", "full_factorial"},
                      {"factors", {{"/particles/total_mass_kg", {0.05, 0.2, 0.1}}}},
                      {"replicates", 2}};
  std::vector<double> order;
  SweepOptions options = with_fake_run();
  options.run = [&](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    order.push_back(scene.particles.total_mass);
    return fake_run(scene, seed, run);
  };
  run_sweep(document_of(case_with(sweep)), study(), options);
  EXPECT_EQ(order, (std::vector<double>{0.2, 0.1, 0.05, 0.2, 0.1, 0.05}));
}

/// One run for three threads: the two that find none join its crew, whoever is first.
TEST_F(SweepTest, LetsIdleThreadsHelpTheLastRuns) {
  SweepOptions options = with_fake_run(3);
  int members = 0;
  options.run = [&](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    const auto begin = std::chrono::steady_clock::now();
    while ((members = run.crew->admit()) < 3 &&
           std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
      std::this_thread::yield();
    std::atomic<int> shares{0};
    run.crew->share([&](int) { ++shares; });
    EXPECT_EQ(shares, members);
    return fake_run(scene, seed, run);
  };
  const SweepSummary summary =
      run_sweep(document_of(case_with({{"design", "full_factorial"}, {"factors", {{"mu_s", {0.4}}}}})),
                study(), options);
  EXPECT_EQ(members, 3);
  EXPECT_EQ(summary.finished, 1);
}

TEST_F(SweepTest, TellsWhereItStands) {
  std::vector<SweepProgress> seen;
  int finished = 0;
  SweepOptions options = with_fake_run(2);
  options.on_progress = [&](const SweepProgress& progress) { seen.push_back(progress); };
  options.on_finished = [&](const StoredRun& run, const RunResult& result) {
    ++finished;
    EXPECT_EQ(static_cast<std::uint64_t>(run.seed), result.seed);
  };
  run_sweep(document_of(case_with(factorial())), study(), options);
  EXPECT_EQ(finished, 12);
  ASSERT_GE(seen.size(), 25U);  // before, and at each start and end
  EXPECT_EQ(seen.front().left, 12);
  EXPECT_FALSE(seen.front().eta_s.has_value());
  for (const SweepProgress& progress : seen) {
    EXPECT_EQ(progress.planned, 12);
    EXPECT_EQ(progress.done + progress.left, 12);
    EXPECT_LE(progress.running, 2);
  }
  EXPECT_EQ(seen.back().done, 12);
  EXPECT_EQ(seen.back().running, 0);
  EXPECT_EQ(seen.back().eta_s, 0.0);
}

/// All runs are equal and cost 10 s of CPU; after the first of four, three are left for one thread: 30 s.
TEST_F(SweepTest, ExpectsTheRestToTakeWhatTheFirstRunsTook) {
  std::vector<SweepProgress> seen;
  SweepOptions options = with_fake_run();
  options.on_progress = [&](const SweepProgress& progress) { seen.push_back(progress); };
  options.run = [](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    RunResult result = fake_run(scene, seed, run);
    result.cost.cpu = 10.0;
    return result;
  };
  const Json sweep = {{"design", "full_factorial"}, {"factors", {{"mu_s", {0.2, 0.4, 0.6, 0.8}}}}};
  run_sweep(document_of(case_with(sweep)), study(), options);
  for (const SweepProgress& progress : seen) {
    if (progress.done > 0 && progress.running == 0) {
      EXPECT_NEAR(*progress.eta_s, 10.0 * progress.left, 1e-9);
    }
  }
  EXPECT_DOUBLE_EQ(*status_of(study()).cpu_left_s, 0.0);
}

}  // namespace
}  // namespace repose::sweep
