#include "sweep/study.hpp"

#include <gtest/gtest.h>

#include "sweep/plan.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kClump = R"({"name": "pair", "spheres": [{"x": -0.001, "y": 0, "z": 0, "r": 0.002},
  {"x": 0.001, "y": 0, "z": 0, "r": 0.002}], "mass": 5e-8, "inertia": [8e-14, 1e-13, 1e-13]})";

/// A case that inherits from one in another folder and names files in both.
class StudyTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "general");
    fs::create_directories(folder_ / "mine");
    Json general = case_with(nullptr);
    general.erase("sweep");
    test::write_text(folder_ / "general/base.json", general.dump());
    test::write_text(folder_ / "mine/points.csv", "mu_s,mu_r\n0.2,0.1\n0.4,0.1\n");
    write_case({{"title", "mine"}});
  }
  void write_case(const Json& more) {
    Json mine = {{"base", "../general/base.json"}, {"sweep", {{"design", "table"}, {"table", "points.csv"}}}};
    mine.update(more);
    test::write_text(case_file(), mine.dump());
  }
  fs::path case_file() const { return folder_ / "mine/case.json"; }
  fs::path study() const { return folder_ / "study"; }
  Study opened() const { return open_or_create_study(study(), CaseDocument::load(case_file())); }

  test::TemporaryFolder folder_;
};

std::vector<std::string> keys_of(const CaseDocument& document) {
  std::vector<std::string> keys;
  for (const PlannedRun& run : make_plan(document).runs) keys.push_back(run.key);
  return keys;
}

TEST_F(StudyTest, HoldsACaseThatNeedsNothingElseAndCanBeMoved) {
  const auto keys = keys_of(CaseDocument::load(case_file()));
  ASSERT_EQ(keys.size(), 2U);
  opened();
  fs::rename(study(), folder_ / "moved");
  fs::remove_all(folder_ / "mine");
  fs::remove_all(folder_ / "general");
  EXPECT_EQ(keys_of(open_study(folder_ / "moved").document), keys);
  EXPECT_EQ(keys_of(CaseDocument::load(folder_ / "moved/case.json")), keys);
}

TEST_F(StudyTest, OpensAgainWithTheSameCase) {
  opened().store.set_case_text(opened().store.case_text());
  EXPECT_EQ(keys_of(opened().document).size(), 2U);
  EXPECT_EQ(std::distance(fs::directory_iterator(study() / "files"), {}), 1);
}

TEST_F(StudyTest, CanBeSweptFromItsOwnCase) {
  opened();
  open_or_create_study(study(), CaseDocument::load(study() / kCaseFile));
  EXPECT_EQ(std::distance(fs::directory_iterator(study() / "files"), {}), 1);
}

TEST_F(StudyTest, GoesOnWithAnotherDesignTitleFrictionOrSpelling) {
  opened();
  test::write_text(folder_ / "mine/points.csv", "mu_s,mu_r\n0.2,0.1\n0.4,0.1\n0.6,0.1\n");
  write_case({{"title", "another"},
              {"contact", {{"rolling_model", "type_a"}, {"particle_particle", {{"rolling_friction", 0.15}}}}},
              {"particles", {{"density_kg_m3", 2500.0}}},
              {"numerics", {{"stiffness_scale", 1}}}});
  EXPECT_EQ(keys_of(opened().document).size(), 3U);
  EXPECT_EQ(keys_of(open_study(study()).document).size(), 3U);
  EXPECT_EQ(open_study(study()).document.find("/title")->get<std::string>(), "another");
  EXPECT_EQ(CaseDocument::load(study() / kCaseFile).find("/title")->get<std::string>(), "another");
}

TEST_F(StudyTest, RefusesAnotherCaseAndNamesEachDifference) {
  opened();
  write_case({{"particles", {{"density_kg_m3", 3000}}}, {"contact", {{"rolling_model", "type_c"}}}});
  const std::string message = message_of([&] { opened(); });
  EXPECT_NE(message.find(study().string() + ": holds the study of another case"), std::string::npos)
      << message;
  EXPECT_NE(
      message.find("mine/case.json: /particles/density_kg_m3 = 3000: differs from the case of the study, "
                   "where it is 2500"),
      std::string::npos)
      << message;
  EXPECT_NE(
      message.find("/contact/rolling_model = \"type_c\": differs from the case of the study, where it is not "
                   "given"),
      std::string::npos)
      << message;
  EXPECT_EQ(open_study(study()).document.find("/particles/density_kg_m3")->get<double>(), 2500);
}

TEST_F(StudyTest, TellsCasesApartByTheContentOfTheirClumps) {
  const Json shapes = {{"particles", {{"shapes", {{{"clump", "pair.json"}}}}}}};
  test::write_text(folder_ / "mine/pair.json", kClump);
  write_case(shapes);
  opened();
  EXPECT_EQ(keys_of(open_study(study()).document), keys_of(CaseDocument::load(case_file())));
  std::string other = kClump;
  other.replace(other.find("0.002"), 5, "0.0021");
  test::write_text(folder_ / "mine/pair.json", other);
  EXPECT_NE(message_of([&] { opened(); }).find("/particles/shapes/0/clump"), std::string::npos);
}

TEST_F(StudyTest, DoesNotOverwriteACaseThatIsNotItsOwn) {
  EXPECT_EQ(message_of([&] { open_or_create_study(folder_ / "mine", CaseDocument::load(case_file())); }),
            case_file().string() +
                ": is of no study and would be overwritten: choose another folder for the study");
  EXPECT_FALSE(fs::exists(folder_ / "mine/study.sqlite"));
}

TEST_F(StudyTest, NamesAFileThatTheCaseNamesAndThatIsMissing) {
  fs::remove(folder_ / "mine/points.csv");
  const std::string message = message_of([&] { opened(); });
  EXPECT_NE(message.find("/sweep/table"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(study()));
}

TEST_F(StudyTest, WithoutACaseIsRefused) {
  Store::open_or_create(study());
  EXPECT_EQ(message_of([&] { open_study(study()); }),
            study().string() + ": holds a study without a case: sweep the case into it again");
}

StoredRun version_of(const std::string& key, const std::string& date, double mu_s) {
  StoredRun run;
  run.run_key = key;
  run.outcome = "completed";
  run.factors = {{"mu_s", mu_s}};
  run.mu_s = mu_s;
  run.finished_at = date;
  return run;
}

TEST_F(StudyTest, MarksRunsThatALaterVersionHasMadeAgain) {
  Study study = opened();
  study.store.put(version_of("old", "2026-01-01T00:00:00Z", 0.2));
  study.store.put(version_of("new", "2026-03-01T00:00:00Z", 0.2));
  study.store.put(version_of("between", "2026-02-01T00:00:00Z", 0.2));
  study.store.put(version_of("other", "2025-01-01T00:00:00Z", 0.3));
  for (const StoredRun& run : runs_of(study.store))
    EXPECT_EQ(run.superseded, run.run_key == "old" || run.run_key == "between") << run.run_key;
}

}  // namespace
}  // namespace repose::sweep
