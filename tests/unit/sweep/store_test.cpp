#include "sweep/store.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "engine/base/input_error.hpp"
#include "support/process.hpp"
#include "sweep/sqlite.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

namespace fs = std::filesystem;

StoredRun run_of(const std::string& key) {
  StoredRun run;
  run.run_key = key;
  run.point = 3;
  run.replicate = 2;
  run.seed = (std::int64_t{1} << 53) - 1;
  run.e_pp = 0.1;
  run.mu_s = 1.0 / 3.0;
  run.mu_r = 5e-324;
  run.factors = {{"mu_s", 1.0 / 3.0}, {"/particles/total_mass_kg", 0.05}};
  run.outcome = "completed";
  run.reason = "it's \"quoted\", μ";
  run.warnings = "few_particles coarse_step";
  run.warning_details = "few_particles: 100 bodies | coarse_step: of 5.1";
  run.reaches_edge = 1;
  run.angle_deg = 30.000000000000004;
  run.angles_deg = {29.0, 31.0, 30.5, std::nullopt};
  run.steps = 123456789012;
  run.bodies = 70;
  run.version = "1-test";
  run.finished_at = "2026-01-31T12:00:00Z";
  return run;
}

bool same_columns(const StoredRun& a, const StoredRun& b) {
  std::vector<std::string> texts;
  for (const StoredRun* run : {&a, &b}) {
    std::string& text = texts.emplace_back();
    visit_columns(*run, [&](const char* name, const auto& value) {
      if constexpr (requires { value.has_value(); })
        text += name + (value ? Json(*value).dump() : std::string("-"));
      else
        text += name + Json(value).dump();
    });
  }
  return texts[0] == texts[1];
}

class StoreTest : public testing::Test {
 protected:
  fs::path study() const { return folder_ / "study"; }
  fs::path file() const { return study() / kStudyFile; }
  std::string refusal() const {
    std::string message = message_of([&] { Store::open(study()); });
    if (const auto at = message.find(study().string()); at != std::string::npos)
      message.erase(at, study().string().size() + 1);
    return message;
  }
  test::TemporaryFolder folder_;
};

TEST_F(StoreTest, GivesBackARunBitForBit) {
  const StoredRun run = run_of("a");
  Store::open_or_create(study()).put(run);
  const auto runs = Store::open(study()).runs();
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_TRUE(same_columns(runs[0], run));
  EXPECT_EQ(runs[0].mu_r, 5e-324);
}

TEST_F(StoreTest, HoldsColumnsThatOtherProgramsRead) {
  Store::open_or_create(study()).put(run_of("a"));
  const Database database(file(), Database::Mode::read);
  EXPECT_EQ(
      database.text("SELECT run_key || ' ' || point || ' ' || seed || ' ' || outcome || ' ' || version FROM "
                    "runs WHERE angle_deg > 30 AND mu_s BETWEEN 0.33 AND 0.34 AND angle_4_deg IS NULL"),
      "a 3 9007199254740991 completed 1-test");
  EXPECT_EQ(database.text("SELECT json_extract(factors, '$.mu_s') = mu_s FROM runs"), "1");
  EXPECT_EQ(database.text("PRAGMA journal_mode"), "delete");
}

TEST_F(StoreTest, GivesBackTheFlanksWithTheirProfiles) {
  Flanks flanks;
  flanks[0] = {0.5, 0.01, 0.03, 0.01, 0.05, {{0.0, 0.03}, {0.05, 1.0 / 3.0}}};
  flanks[1].angle = std::numeric_limits<double>::quiet_NaN();
  Store store = Store::open_or_create(study());
  store.put(run_of("a"), flanks);
  store.put(run_of("b"));
  const auto back = store.flanks("a");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ((*back)[0].z0, 0.03);
  ASSERT_EQ((*back)[0].profile.size(), 2U);
  EXPECT_EQ((*back)[0].profile[1].z, 1.0 / 3.0);
  EXPECT_TRUE(std::isnan((*back)[1].angle));
  EXPECT_FALSE(store.flanks("b").has_value());
}

TEST_F(StoreTest, KeepsTheFirstResultOfAKeyAndTellsOfAnother) {
  Store store = Store::open_or_create(study());
  StoredRun run = run_of("a");
  EXPECT_EQ(store.put(run), Store::Put::stored);
  run.cpu_s = 5.0;
  run.finished_at = "2027-01-31T12:00:00Z";
  EXPECT_EQ(store.put(run), Store::Put::already_there);
  *run.angle_deg = std::nextafter(*run.angle_deg, 90.0);
  EXPECT_EQ(store.put(run), Store::Put::differs);
  EXPECT_EQ(*store.runs()[0].angle_deg, *run_of("a").angle_deg);
  EXPECT_FALSE(store.runs()[0].cpu_s.has_value());
}

TEST_F(StoreTest, LetsAFailedRunGiveWayToAnotherButNotTheOtherWayRound) {
  Store store = Store::open_or_create(study());
  StoredRun failed;
  failed.run_key = "a";
  take_failure(failed, "out of memory");
  EXPECT_EQ(store.put(failed), Store::Put::stored);
  EXPECT_EQ(store.put(run_of("a")), Store::Put::stored);
  EXPECT_EQ(store.put(failed), Store::Put::already_there);
  ASSERT_EQ(store.runs().size(), 1U);
  EXPECT_TRUE(store.runs()[0].completed());
}

TEST_F(StoreTest, NumbersItsRunsAnewWhenTheDesignChanges) {
  Store store = Store::open_or_create(study());
  for (const char* key : {"a", "b", "c"}) store.put(run_of(key));
  store.relabel({{"c", {1, 1, ""}}, {"a", {2, 5, "soft"}}});
  const auto runs = store.runs();
  EXPECT_EQ(runs[0].run_key, "c");
  EXPECT_EQ(runs[1].run_key, "a");
  EXPECT_EQ(runs[1].point, 2);
  EXPECT_EQ(runs[1].replicate, 5);
  EXPECT_EQ(runs[1].variant, "soft");
  EXPECT_EQ(runs[2].run_key, "b");
  EXPECT_FALSE(runs[2].point.has_value());
}

TEST_F(StoreTest, TakesTheRunsOfOthersAllOrNothing) {
  Store one = Store::open_or_create(folder_ / "one");
  Store two = Store::open_or_create(folder_ / "two");
  Store both = Store::open_or_create(study());
  one.put(run_of("a"), Flanks{});
  one.put(run_of("b"));
  two.put(run_of("b"));
  two.put(run_of("c"));
  EXPECT_TRUE(both.take_from({&one, &two}).empty());
  EXPECT_EQ(both.runs().size(), 3U);
  EXPECT_TRUE(both.flanks("a").has_value());

  StoredRun other = run_of("b");
  other.angle_deg = 12.0;
  Store three = Store::open_or_create(folder_ / "three");
  three.put(other);
  three.put(run_of("d"));
  EXPECT_EQ(both.take_from({&three}), std::vector<std::string>{"b"});
  EXPECT_EQ(both.runs().size(), 3U);
}

TEST_F(StoreTest, RefusesAFolderWithoutAStudy) {
  EXPECT_EQ(message_of([&] { Store::open(study()); }),
            study().string() + ": holds no study: there is no study.sqlite in it");
}

TEST_F(StoreTest, RefusesAFileInPlaceOfAFolder) {
  test::write_text(study(), "a file");
  EXPECT_NE(message_of([&] { Store::open_or_create(study()); }).find("cannot be a study's folder"),
            std::string::npos);
}

TEST_F(StoreTest, RefusesAFileThatIsNoDatabase) {
  fs::create_directories(study());
  test::write_text(file(), std::string(5000, 'x'));
  EXPECT_EQ(refusal(), "study.sqlite: is not a study: file is not a database");
  EXPECT_THROW(Store::open_or_create(study()), InputError);
}

TEST_F(StoreTest, RefusesADatabaseOfSomethingElse) {
  fs::create_directories(study());
  Database(file(), Database::Mode::create).execute("CREATE TABLE songs (title TEXT)");
  EXPECT_EQ(refusal(), "study.sqlite: is a database of something else, not a study");
  EXPECT_THROW(Store::open_or_create(study()), InputError);
}

TEST_F(StoreTest, RefusesAStudyOfANewerVersion) {
  Store::open_or_create(study());
  Database(file(), Database::Mode::write).execute("PRAGMA user_version = 99");
  EXPECT_EQ(refusal(), "study.sqlite: was written by a newer version of the program (schema 99, known: 3)");
}

TEST_F(StoreTest, GivesAStudyOfAnOlderVersionTheColumnsItLacksAndKeepsItsRuns) {
  StoredRun old = run_of("old");
  old.warnings = old.warning_details = "";
  old.reaches_edge.reset();
  Store::open_or_create(study()).put(old);
  {
    Database database(file(), Database::Mode::write);
    for (const char* column : {"warnings", "warning_details", "mass_lost_kg", "reaches_edge",
                               "energy_imbalance", "column_overlap_ratio", "stability_number", "variant"})
      database.execute(std::string("ALTER TABLE runs DROP COLUMN ") + column);
    database.execute("PRAGMA user_version = 1");
  }
  Store store = Store::open(study());
  ASSERT_EQ(store.runs().size(), 1U);
  EXPECT_TRUE(same_columns(store.runs()[0], old));
  EXPECT_EQ(store.put(run_of("new")), Store::Put::stored);
  EXPECT_EQ(Store::open(study()).runs().size(), 2U);
  EXPECT_EQ(Database(file(), Database::Mode::read).integer("PRAGMA user_version"), 3);
}

TEST(CountWarnings, SplitsWhatARunCarriesAndKeepsTheFirstText) {
  std::map<std::string, WarningCount> counts;
  StoredRun run = run_of("a");
  count_warnings(run, counts);
  run.warning_details = "coarse_step: of 9";
  count_warnings(run, counts);
  run.warning_details = "";
  count_warnings(run, counts);
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts.at("few_particles").runs, 1);
  EXPECT_EQ(counts.at("coarse_step").runs, 2);
  EXPECT_EQ(counts.at("coarse_step").example, "of 5.1");
}

TEST_F(StoreTest, RefusesADamagedStudy) {
  {
    Store store = Store::open_or_create(study());
    for (int i = 0; i < 20; ++i) {
      StoredRun run = run_of(std::to_string(i));
      run.reason = std::string(3000, 'r');
      store.put(run);
    }
  }
  std::string bytes = test::text_of(file());
  ASSERT_GT(bytes.size(), 40000U);
  std::fill(bytes.begin() + 8192, bytes.end() - 8192, '\x5a');
  test::write_text(file(), bytes);
  EXPECT_TRUE(refusal().starts_with("study.sqlite: is damaged (")) << refusal();
  test::write_text(file(), bytes.substr(0, 9000));
  EXPECT_TRUE(refusal().starts_with("study.sqlite: is damaged (")) << refusal();
}

/// A process that is killed while SQLite has written half of a transaction into the file: the journal it
/// leaves takes that half back.
TEST_F(StoreTest, IsWholeAfterAKillInTheMiddleOfAWrite) {
  StoredRun run = run_of("kept");
  run.reason = std::string(3000, 'r');
  Store::open_or_create(study()).put(run);
  const pid_t victim = fork();
  if (victim == 0) {
    Database database(file(), Database::Mode::write);
    database.execute("PRAGMA cache_size = 2");  // pages go to the file before the end
    const Transaction transaction(database);
    for (int i = 0; i < 50; ++i)
      database.execute("INSERT INTO profiles VALUES ('" + std::to_string(i) + "', hex(zeroblob(5000)))");
    database.execute("UPDATE runs SET angle_deg = 1");
    raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(victim, &status, 0), victim);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_GT(fs::file_size(file()), 100000U);  // half of it was there
  ASSERT_TRUE(fs::exists(file().string() + "-journal"));
  const Store store = Store::open(study());
  ASSERT_EQ(store.runs().size(), 1U);
  EXPECT_TRUE(same_columns(store.runs()[0], run));
  EXPECT_FALSE(store.flanks("1").has_value());
}

TEST_F(StoreTest, StartsAnewInAnEmptyFileThatAKilledProcessLeft) {
  fs::create_directories(study());
  test::write_text(file(), "");
  Store store = Store::open_or_create(study());
  EXPECT_EQ(store.put(run_of("a")), Store::Put::stored);
}

}  // namespace
}  // namespace repose::sweep
