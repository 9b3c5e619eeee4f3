#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>

#include "sweep/study.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

namespace fs = std::filesystem;

TEST_F(SweepTest, MakesEveryRunOnceAndStoresItsResult) {
  const SweepSummary summary = run_sweep(document_of(case_with(factorial())), study(), with_fake_run());
  EXPECT_EQ(summary.planned, 12);
  EXPECT_EQ(summary.finished, 12);
  EXPECT_EQ(summary.present, 0);
  EXPECT_EQ(summary.left, 0);
  EXPECT_FALSE(summary.interrupted);
  EXPECT_EQ(summary.outcomes, (std::map<std::string, int>{{"completed", 12}}));
  const auto runs = open_study(study()).store.runs();
  ASSERT_EQ(runs.size(), 12U);
  EXPECT_EQ(runs.front().point, 1);
  EXPECT_EQ(runs.front().replicate, 1);
  EXPECT_EQ(runs.back().point, 6);
  EXPECT_EQ(runs.back().replicate, 2);
  EXPECT_EQ(runs.front().factors, (FactorValues{{"mu_s", 0.2}, {"mu_r", 0.05}}));
  EXPECT_EQ(runs.front().e_pp, 0.3);  // not varied: that of the case
  EXPECT_EQ(runs.front().version, engine_version());
}

/// The record is the result, converted: against a run made here, by its key and seed. Exact.
TEST_F(SweepTest, StoresWhatTheRunReturned) {
  const CaseDocument document = document_of(case_with(factorial(1)));
  run_sweep(document, study(), with_fake_run());
  const Plan plan = make_plan(document);
  const auto runs = open_study(study()).store.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& planned = plan.runs[i];
    const RunResult result = fake_run(plan.points[planned.point].scene, planned.seed, {});
    EXPECT_EQ(runs[i].run_key, run_key(plan.points[planned.point].scene, planned.seed));
    EXPECT_EQ(runs[i].angle_deg, degrees(result.measurement.angle));
    EXPECT_EQ(runs[i].angles_deg[3], degrees(result.measurement.flanks[3].angle));
    EXPECT_EQ(runs[i].peak_height_mm, 1e3 * result.responses.peak_height);
    EXPECT_EQ(runs[i].steps, result.cost.steps);
    EXPECT_EQ(open_study(study()).store.flanks(planned.key)->at(2).profile[1].r,
              result.measurement.flanks[2].profile[1].r);
  }
}

TEST_F(SweepTest, GivesTheSameResultsWithAnyNumberOfThreads) {
  const std::string expected = undisturbed(factorial(4));
  for (const int threads : {2, 5}) {
    const fs::path folder = folder_ / std::to_string(threads);
    run_sweep(document_of(case_with(factorial(4))), folder, with_fake_run(threads));
    EXPECT_EQ(results_in(folder), expected) << threads << " threads";
  }
}

/// The engine itself, on 75 spheres.
TEST_F(SweepTest, GivesTheSameBitsWithOneAndTwoThreadsOfTheEngine) {
  Json design = {{"design", "full_factorial"}, {"factors", {{"mu_s", {0.2, 0.6}}}}, {"replicates", 2}};
  SweepOptions options;
  options.threads = 1;
  EXPECT_EQ(run_sweep(document_of(case_with(design)), folder_ / "one", options).finished, 4);
  options.threads = 2;
  run_sweep(document_of(case_with(design)), folder_ / "two", options);
  EXPECT_EQ(results_in(folder_ / "one"), results_in(folder_ / "two"));
}

TEST_F(SweepTest, TwoProcessesMayFillOneStudy) {
  const auto part = [&](int index) {
    SweepOptions options = with_fake_run();
    options.shard = {index, 2};
    run_sweep(document_of(case_with(factorial())), study(), options);
  };
  std::thread other(part, 2);
  part(1);
  other.join();
  EXPECT_EQ(results_in(study()), undisturbed(factorial()));
}

TEST_F(SweepTest, MakesOnlyWhatIsMissingWhenCalledAgain) {
  run_sweep(document_of(case_with(factorial())), study(), with_fake_run());
  SweepOptions options = with_fake_run();
  options.run = [](const Scene&, std::uint64_t, const RunOptions&) -> RunResult {
    throw std::logic_error("nothing is missing");
  };
  const SweepSummary summary = run_sweep(document_of(case_with(factorial())), study(), options);
  EXPECT_EQ(summary.present, 12);
  EXPECT_EQ(summary.finished, 0);
}

TEST_F(SweepTest, GoesOnWhenTheDesignIsExtended) {
  run_sweep(document_of(case_with(factorial())), study(), with_fake_run());
  Json larger = factorial(3);
  larger["factors"]["mu_s"] = {0.1, 0.2, 0.5, 0.8};
  const SweepSummary summary = run_sweep(document_of(case_with(larger)), study(), with_fake_run(2));
  EXPECT_EQ(summary.planned, 24);
  EXPECT_EQ(summary.present, 12);
  EXPECT_EQ(summary.finished, 12);
  EXPECT_EQ(results_in(study()), undisturbed(larger));  // also numbered anew
}

TEST_F(SweepTest, KeepsRunsThatTheDesignNoLongerHas) {
  run_sweep(document_of(case_with(factorial())), study(), with_fake_run());
  Json smaller = factorial();
  smaller["factors"]["mu_s"] = {0.2, 0.5};
  run_sweep(document_of(case_with(smaller)), study(), with_fake_run());
  const StudyStatus status = status_of(study());
  EXPECT_EQ(status.planned, 8);
  EXPECT_EQ(status.done, 8);
  EXPECT_EQ(status.outside, 4);
  EXPECT_EQ(status.of_other_instructions, 0);
  EXPECT_EQ(open_study(study()).store.runs().size(), 12U);
}

TEST_F(SweepTest, KeepsWhatIsFinishedWhenStopped) {
  std::atomic<bool> stop = false;
  std::atomic<int> calls = 0;
  SweepOptions options = with_fake_run(2);
  options.stop = &stop;
  options.run = [&](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    if (++calls == 4) stop = true;
    RunResult result = fake_run(scene, seed, run);
    if (run.stop->load()) result.outcome = Outcome::interrupted;
    return result;
  };
  const SweepSummary summary = run_sweep(document_of(case_with(factorial())), study(), options);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_GE(summary.finished, 2);  // the fourth call and one beside it are interrupted
  EXPECT_LE(summary.finished, 3);
  EXPECT_LE(calls.load(), 5);
  EXPECT_EQ(summary.left, 12 - summary.finished);
  EXPECT_EQ(open_study(study()).store.runs().size(), static_cast<std::size_t>(summary.finished));

  const SweepSummary rest = run_sweep(document_of(case_with(factorial())), study(), with_fake_run());
  EXPECT_EQ(rest.present, summary.finished);
  EXPECT_FALSE(rest.interrupted);
  EXPECT_EQ(results_in(study()), undisturbed(factorial()));
}

TEST_F(SweepTest, StartsNothingWhenStoppedBefore) {
  const std::atomic<bool> stop = true;
  SweepOptions options = with_fake_run();
  options.stop = &stop;
  const SweepSummary summary = run_sweep(document_of(case_with(factorial())), study(), options);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(summary.finished, 0);
}

TEST_F(SweepTest, StoresAFailedRunGoesOnWithTheOthersAndTriesItAgain) {
  SweepOptions options = with_fake_run(2);
  options.run = [](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    if (scene.contact.particle_particle.static_friction == 0.5) throw std::bad_alloc();
    return fake_run(scene, seed, run);
  };
  const SweepSummary summary = run_sweep(document_of(case_with(factorial())), study(), options);
  EXPECT_EQ(summary.finished, 12);
  EXPECT_EQ(summary.outcomes, (std::map<std::string, int>{{"completed", 8}, {"failed", 4}}));
  const StudyStatus status = status_of(study());
  EXPECT_EQ(status.left, 4);
  ASSERT_EQ(status.not_completed.size(), 4U);
  EXPECT_EQ(status.not_completed[0].reason, std::bad_alloc().what());
  EXPECT_FALSE(status.not_completed[0].angle_deg.has_value());

  EXPECT_EQ(run_sweep(document_of(case_with(factorial())), study(), with_fake_run()).finished, 4);
  EXPECT_EQ(results_in(study()), undisturbed(factorial()));
}

TEST_F(SweepTest, KeepsOtherOutcomesWithTheirReasonAndNoAngle) {
  SweepOptions options = with_fake_run();
  options.run = [](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    RunResult result = fake_run(scene, seed, run);
    if (scene.contact.particle_particle.rolling_friction == 0.05) {
      result.outcome = Outcome::timed_out;
      result.reason = "not at rest after 5 s";
    }
    return result;
  };
  run_sweep(document_of(case_with(factorial())), study(), options);
  const StudyStatus status = status_of(study());
  EXPECT_EQ(status.outcomes, (std::map<std::string, int>{{"completed", 6}, {"timed_out", 6}}));
  EXPECT_EQ(status.left, 0);
  for (const StoredRun& run : status.not_completed) {
    EXPECT_EQ(run.reason, "not at rest after 5 s");
    EXPECT_FALSE(run.angle_deg.has_value());
    EXPECT_TRUE(run.mass_on_base_kg.has_value());
  }
}

TEST_F(SweepTest, StopsWhenItsCallerThrows) {
  SweepOptions options = with_fake_run(2);
  options.on_finished = [](const StoredRun&, const RunResult&) {
    throw std::runtime_error("disk of the caller");
  };
  EXPECT_THROW(run_sweep(document_of(case_with(factorial())), study(), options), std::runtime_error);
  EXPECT_LE(open_study(study()).store.runs().size(), 2U);
}

TEST_F(SweepTest, RunsNothingAndWritesNothingForABadDesign) {
  Json sweep = factorial();
  sweep["factors"]["mu_s"] = {0.2, -1};
  EXPECT_THROW(run_sweep(document_of(case_with(sweep)), study(), with_fake_run()), InputError);
  EXPECT_FALSE(fs::exists(study()));
}

TEST_F(SweepTest, ReportsAStudyThatIsHalfDone) {
  SweepOptions options = with_fake_run();
  options.shard = {1, 2};
  run_sweep(document_of(case_with(factorial())), study(), options);
  const StudyStatus status = status_of(study());
  EXPECT_EQ(status.planned, 12);
  EXPECT_EQ(status.done, 6);
  EXPECT_EQ(status.left, 6);
  EXPECT_EQ(status.outside, 0);
  double cpu = 0;
  for (const StoredRun& run : open_study(study()).store.runs()) cpu += *run.cpu_s;
  EXPECT_NEAR(*status.cpu_left_s, cpu, 0.7 * cpu);  // runs of 0.5 to 1.5 s
}

TEST_F(SweepTest, ShardsTogetherAreTheWhole) {
  const CaseDocument document = document_of(case_with(factorial(3)));
  std::vector<fs::path> shards;
  for (int i = 1; i <= 4; ++i) {
    SweepOptions options = with_fake_run();
    options.shard = {i, 4};
    shards.push_back(folder_ / ("shard" + std::to_string(i)));
    const SweepSummary summary = run_sweep(document, shards.back(), options);
    EXPECT_GE(summary.planned, 4);  // 18 runs in four parts
    EXPECT_LE(summary.planned, 5);
  }
  EXPECT_EQ(merge_studies(shards, study()), 18);
  EXPECT_EQ(results_in(study()), undisturbed(factorial(3)));
  EXPECT_EQ(status_of(study()).left, 0);
  EXPECT_EQ(merge_studies(shards, study()), 18);  // again: nothing new
}

TEST_F(SweepTest, MergeRefusesOtherCasesAndOtherResults) {
  run_sweep(document_of(case_with(factorial())), folder_ / "one", with_fake_run());
  Json other = case_with(factorial());
  other["walls"]["poisson_ratio"] = 0.3;
  run_sweep(document_of(other), folder_ / "other", with_fake_run());
  EXPECT_NE(message_of([&] {
              merge_studies({folder_ / "one", folder_ / "other"}, study());
            }).find("/walls/poisson_ratio = 0.3: differs"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(study()));
  EXPECT_NE(message_of([&] {
              merge_studies({folder_ / "one", folder_ / "none"}, study());
            }).find("holds no study"),
            std::string::npos);

  SweepOptions options = with_fake_run();
  options.run = [](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    RunResult result = fake_run(scene, seed, run);
    if (scene.contact.particle_particle.static_friction == 0.8) result.measurement.angle += 1e-15;
    return result;
  };
  run_sweep(document_of(case_with(factorial())), folder_ / "two", options);
  const std::string message = message_of([&] { merge_studies({folder_ / "one", folder_ / "two"}, study()); });
  int named = 0;
  for (const StoredRun& run : open_study(folder_ / "one").store.runs()) {
    const bool is_named = message.find(run.run_key) != std::string::npos;
    EXPECT_EQ(is_named, run.mu_s == 0.8);
    named += is_named ? 1 : 0;
  }
  EXPECT_EQ(named, 4);
  EXPECT_NE(message.find((folder_ / "two").string()), std::string::npos)
      << "the studies that disagree are named";
  EXPECT_FALSE(fs::exists(study())) << "nothing stays of a merge that is refused";
}

constexpr const char* kStudyVariable = "REPOSE_TEST_STUDY";

constexpr int kRunsBeforeItHangs = 10;

/// Not a test of its own: the process that the next test kills. It hangs in the middle of its sweep.
TEST(KilledSweep, DISABLED_Victim) {
  std::atomic<int> calls = 0;
  SweepOptions options = with_fake_run(2);
  options.run = [&](const Scene& scene, std::uint64_t seed, const RunOptions& run) {
    if (++calls > kRunsBeforeItHangs) std::this_thread::sleep_for(std::chrono::minutes(2));
    return fake_run(scene, seed, run);
  };
  run_sweep(document_of(case_with(factorial(6))), std::getenv(kStudyVariable), options);
}

TEST_F(SweepTest, LosesNothingThatWasFinishedWhenItIsKilled) {
  setenv(kStudyVariable, study().c_str(), 1);
  test::Process victim(fs::read_symlink("/proc/self/exe"),
                       {"--gtest_also_run_disabled_tests", "--gtest_filter=KilledSweep.DISABLED_Victim"});
  const auto stored = [&] {
    return fs::exists(study() / kCaseFile) ? open_study(study()).store.runs().size() : 0;
  };
  ASSERT_TRUE(test::eventually([&] { return stored() == kRunsBeforeItHangs; })) << victim.err_so_far();
  victim.send(SIGKILL);
  EXPECT_EQ(victim.wait().signal, SIGKILL);
  EXPECT_EQ(stored(), std::size_t{kRunsBeforeItHangs});
  const SweepSummary rest = run_sweep(document_of(case_with(factorial(6))), study(), with_fake_run(2));
  EXPECT_EQ(rest.present, kRunsBeforeItHangs);
  EXPECT_EQ(rest.finished, 36 - kRunsBeforeItHangs);
  EXPECT_EQ(results_in(study()), undisturbed(factorial(6)));
}

}  // namespace
}  // namespace repose::sweep
