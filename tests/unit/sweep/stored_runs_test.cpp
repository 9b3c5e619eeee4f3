#include "sweep/stored_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "sweep/study.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

constexpr const char* kLater = "2090-01-01T00:00:00Z";

/// Studies of one design, made here, and as a build for another instruction set would have left them: its
/// keys, its version, angles that have been rounded otherwise until grains went another way.
class StoredRunsTest : public SweepTest {
 protected:
  const CaseDocument document_ = document_of(case_with(factorial()));
  const Plan plan_ = make_plan(document_);

  std::filesystem::path made_here() const {
    run_sweep(document_, folder_ / "here", with_fake_run());
    return folder_ / "here";
  }
  /// @param finished  when; empty: as those made here
  std::filesystem::path made_elsewhere(const std::string& finished = "") const {
    Study study = open_or_create_study(folder_ / "elsewhere", document_);
    const Study here = open_study(made_here());
    for (StoredRun run : here.store.runs()) {
      const auto planned = std::ranges::find(plan_.runs, run.run_key, &PlannedRun::key);
      run.run_key = planned->other_keys.back();
      run.version = "another set";
      *run.angle_deg += 1.0;
      if (!finished.empty()) run.finished_at = finished;
      study.store.put(run);
    }
    return study.folder;
  }
};

TEST_F(StoredRunsTest, ThoseOfAnotherInstructionSetAreNotMadeAgain) {
  SweepOptions options = with_fake_run();
  options.run = [](const Scene&, std::uint64_t, const RunOptions&) -> RunResult {
    throw std::logic_error("nothing is missing");
  };
  const SweepSummary summary = run_sweep(document_, made_elsewhere(), options);
  EXPECT_EQ(summary.present, 12);
  EXPECT_EQ(summary.finished, 0);
  EXPECT_EQ(summary.outcomes, (std::map<std::string, int>{{"completed", 12}}));
  const StudyStatus status = status_of(folder_ / "elsewhere");
  EXPECT_EQ(status.done, 12);
  EXPECT_EQ(status.outside, 0);
  EXPECT_EQ(status.of_other_instructions, 12);
  for (const StoredRun& run : runs_of(open_study(folder_ / "elsewhere").store)) EXPECT_FALSE(run.superseded);
}

TEST_F(StoredRunsTest, ThoseOfTwoInstructionSetsMakeOneStudy) {
  SweepOptions half = with_fake_run();
  half.shard = {1, 2};
  run_sweep(document_, folder_ / "half", half);
  Study study = open_study(folder_ / "half");
  const Study elsewhere = open_study(made_elsewhere());
  const StoredRuns have(study.store.runs());
  for (const StoredRun& run : elsewhere.store.runs()) {
    const auto planned = std::ranges::find_if(
        plan_.runs, [&](const PlannedRun& of) { return of.other_keys.back() == run.run_key; });
    if (have.find(*planned) == nullptr) study.store.put(run);
  }
  const StudyStatus status = status_of(study.folder);
  EXPECT_EQ(status.left, 0);
  EXPECT_EQ(status.of_other_instructions, 6);
}

/// Which one stands does not depend on who asks: the later, here the one from elsewhere.
TEST_F(StoredRunsTest, OfTwoThatAreThereTheLaterStands) {
  merge_studies({made_here(), made_elsewhere(kLater)}, study());
  const std::vector<StoredRun> runs = runs_of(open_study(study()).store);
  ASSERT_EQ(runs.size(), 24U);
  for (const StoredRun& run : runs) {
    EXPECT_TRUE(run.point.has_value());
    EXPECT_EQ(run.superseded, run.version == engine_version());
  }
  const StoredRuns stored(runs);
  for (const PlannedRun& planned : plan_.runs) EXPECT_EQ(stored.find(planned)->version, "another set");
  EXPECT_EQ(status_of(study()).outside, 0);
}

TEST_F(StoredRunsTest, OneThatFailedGivesWayToAnEarlierOne) {
  StoredRun run, failed;
  run.run_key = plan_.runs[0].key, run.outcome = "completed", run.finished_at = "2026-01-01T00:00:00Z";
  failed.run_key = plan_.runs[0].other_keys[0], failed.outcome = kFailed, failed.finished_at = kLater;
  EXPECT_EQ(StoredRuns({run, failed}).find(plan_.runs[0])->outcome, "completed");
  EXPECT_TRUE(StoredRuns({run, failed}).is_done(plan_.runs[0]));
  EXPECT_FALSE(StoredRuns({failed}).is_done(plan_.runs[0]));
  EXPECT_EQ(StoredRuns({run}).find(plan_.runs[1]), nullptr);
}

TEST_F(StoredRunsTest, AreFoundBySceneAndSeedAsByPlan) {
  const StoredRuns stored(open_study(made_elsewhere()).store.runs());
  for (const PlannedRun& planned : plan_.runs)
    EXPECT_EQ(stored.find(plan_.points[planned.point].scene, planned.seed), stored.find(planned));
}

}  // namespace
}  // namespace repose::sweep
