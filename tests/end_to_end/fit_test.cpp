// repose fit and invert: from a table to the equation, from the equation and an angle to friction.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

namespace fs = std::filesystem;

/// α = 56.61 e^0.01 μr^0.084 μs^0.25, article eq. 13 [deg].
double article_angle(double e, double mu_s, double mu_r) {
  return 56.61 * std::pow(e, 0.01) * std::pow(mu_r, 0.084) * std::pow(mu_s, 0.25);
}

/// A table of the article's equation over its ranges, e from 0.1 on.
std::string article_table() {
  std::string csv = "run,e_pp,mu_s,mu_r,angle_deg,colour\n";
  int run = 0;
  for (const double e : {0.1, 0.3, 0.6})
    for (const double mu_s : {0.2, 0.5, 0.8})
      for (const double mu_r : {0.05, 0.1, 0.2})
        csv += fmt::format("{},{},{},{},{:.17g},red\n", ++run, e, mu_s, mu_r, article_angle(e, mu_s, mu_r));
  return csv;
}

std::string write_table(const TemporaryFolder& folder, const std::string& csv) {
  write_text(folder / "table.csv", csv);
  return (folder / "table.csv").string();
}

TEST(Fit, FindsTheEquationThatATableWasMadeFromAndHasEveryKeyOfTheContract) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  for (const std::string loss : {"least-squares", "minimax"}) {
    const Finished run = repose({"fit", table, "--loss", loss, "--json"});
    ASSERT_EQ(run.code, 0) << run.err;
    const Json json = Json::parse(run.out);
    // The table is exact to 17 digits; 1e-6 is what the optimiser is stopped at.
    EXPECT_NEAR(json.at("C").get<double>(), 56.61, 56.61e-6);
    EXPECT_NEAR(json.at("a").get<double>(), 0.01, 1e-6);
    EXPECT_NEAR(json.at("b").get<double>(), 0.084, 1e-6);
    EXPECT_NEAR(json.at("c").get<double>(), 0.25, 1e-6);
    EXPECT_LT(json.at("worst_error_deg").get<double>(), 1e-4);
    EXPECT_LT(json.at("rms_error_deg").get<double>(), 1e-4);
    EXPECT_GT(json.at("r_squared").get<double>(), 1.0 - 1e-6);
    EXPECT_EQ(json.at("points"), 27);
    EXPECT_EQ(json.at("excluded").size(), 0U);
    for (const char* key : {"standard_error", "interval_95", "correlation", "worst_point", "domain"})
      EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json.at("domain").at("mu_s"), Json({0.2, 0.8}));
  }
}

/// The article's table, 4 % too low, as a cheap test gives it, with a few rows of the reference.
std::string table_of_two(const std::string& word) {
  std::string csv = "e_pp,mu_s,mu_r,angle_deg,fidelity\n";
  for (const double e : {0.1, 0.3, 0.6})
    for (const double mu_s : {0.2, 0.5, 0.8})
      for (const double mu_r : {0.05, 0.1, 0.2}) {
        csv += fmt::format("{},{},{},{:.17g},cheap\n", e, mu_s, mu_r, article_angle(e, mu_s, mu_r) / 1.04);
        if (e == 0.3 && mu_r != 0.1)
          csv += fmt::format("{},{},{},{:.17g},{}\n", e, mu_s, mu_r, article_angle(e, mu_s, mu_r), word);
      }
  return csv;
}

void expect_articles_equation(const Finished& run) {
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_NEAR(json.at("C").get<double>(), 56.61, 56.61e-5);
  EXPECT_NEAR(json.at("c").get<double>(), 0.25, 1e-5);
  EXPECT_NEAR(json.at("correction").at("C").get<double>(), 1.04, 1e-5);
  EXPECT_EQ(json.at("correction").at("cheap_rows"), 27);
  EXPECT_EQ(json.at("correction").at("reference_rows"), 6);
}

TEST(Fit, TakesACheapTestAndAFewRowsOfTheReferenceTogether) {
  const TemporaryFolder folder;
  const std::string csv = table_of_two("reference");
  expect_articles_equation(repose({"fit", write_table(folder, csv), "--json"}));
  const Finished words = repose({"fit", write_table(folder, csv)});
  EXPECT_NE(words.out.find("reference = cheap × 1.04"), std::string::npos) << words.out;

  // The same in two files.
  std::string cheap = "e_pp,mu_s,mu_r,angle_deg\n", reference = cheap;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t comma = line.rfind(',');
    (line.substr(comma + 1) == "cheap" ? cheap : reference) += line.substr(0, comma) + "\n";
  }
  write_text(folder / "cheap.csv", cheap);
  expect_articles_equation(
      repose({"fit", write_table(folder, reference), "--cheap", (folder / "cheap.csv").string(), "--json"}));
}

TEST(Fit, SaysWhatIsWrongWithACheapTest) {
  const TemporaryFolder folder;
  const Finished word = repose({"fit", write_table(folder, table_of_two("referrence"))});
  EXPECT_EQ(word.code, 2);
  EXPECT_NE(word.err.find("must be cheap or reference"), std::string::npos) << word.err;
  const Finished missing =
      repose({"fit", (folder / "none.csv").string(), "--cheap", (folder / "neither.csv").string()});
  EXPECT_EQ(missing.code, 2);
  for (const char* file : {"none.csv", "neither.csv"})
    EXPECT_NE(missing.err.find(file), std::string::npos) << missing.err;
  const std::string table = write_table(folder, table_of_two("reference"));
  const Finished itself = repose({"fit", table, "--cheap", table});
  EXPECT_EQ(itself.code, 2);
  EXPECT_NE(itself.err.find("another source"), std::string::npos) << itself.err;
  const Finished loss = repose({"fit", write_table(folder, table_of_two("reference")), "--loss", "minimax"});
  EXPECT_EQ(loss.code, 2);
  EXPECT_NE(loss.err.find("least squares"), std::string::npos) << loss.err;
}

TEST(Fit, RowsThatTheLawCannotTakeAreNamedWithTheirReason) {
  const TemporaryFolder folder;
  const std::string table = write_table(
      folder, article_table() + "28,0,0.5,0.1,30,red\n29,0.3,0.5,0.1,,red\n30,0.3,0.5,0,20,red\n");
  const Json json = Json::parse(repose({"fit", table, "--json"}).out);
  EXPECT_EQ(json.at("points"), 27);
  ASSERT_EQ(json.at("excluded").size(), 3U);
  std::string all;
  for (const Json& row : json.at("excluded")) {
    EXPECT_NE(row.at("reason"), "");
    all += row.at("label").get<std::string>() + ";";
  }
  for (const char* line : {"line 29", "line 30", "line 31"})
    EXPECT_NE(all.find(line), std::string::npos) << all;
  const Finished words = repose({"fit", table});
  EXPECT_EQ(lines_with(words.out, "left out"), 3) << words.out;
}

/// A chart's table has hundreds of rows that are none of the reference's.
TEST(Fit, RowsThatAreLeftOutForOneReasonAreOneLineOfWords) {
  const TemporaryFolder folder;
  std::string csv = article_table() + "28,0.3,0.5,0.1,,red\n";
  for (int row = 0; row < 40; ++row) csv += "29,0.3,0.5,0,20,red\n";
  const std::string table = write_table(folder, csv);
  const Finished words = repose({"fit", table});
  EXPECT_EQ(lines_with(words.out, "left out"), 2) << words.out;
  EXPECT_EQ(lines_with(words.out, "left out: 40 points, the first line 30 "), 1) << words.out;
  EXPECT_EQ(Json::parse(repose({"fit", table, "--json"}).out).at("excluded").size(), 41U);
}

TEST(Fit, RowsWithAnotherOutcomeThanCompletedAreLeftOut) {
  const TemporaryFolder folder;
  std::string csv = "e_pp,mu_s,mu_r,angle_deg,outcome\n";
  for (const double mu_s : {0.2, 0.5, 0.8})
    for (const double mu_r : {0.05, 0.2})
      csv += fmt::format("0.3,{},{},{},completed\n", mu_s, mu_r, article_angle(0.3, mu_s, mu_r));
  const Json json =
      Json::parse(repose({"fit", write_table(folder, csv + "0.3,0.1,0.1,,no_heap\n"), "--json"}).out);
  EXPECT_EQ(json.at("points"), 6);
  EXPECT_NE(json.at("excluded").at(0).at("reason").get<std::string>().find("no_heap"), std::string::npos);
}

/// The table of a study says which runs are none of its design's: the study's folder leaves them out, and so
/// does its table.
TEST(Fit, RunsOfAnExportedTableAreThoseOfItsStudy) {
  const TemporaryFolder folder;
  std::string csv = "run_key,point,variant,e_pp,mu_s,mu_r,angle_deg\n";
  for (const double mu_s : {0.2, 0.5, 0.8})
    for (const double mu_r : {0.05, 0.2})
      csv += fmt::format("k,1,reference,0.3,{},{},{}\n", mu_s, mu_r, article_angle(0.3, mu_s, mu_r));
  csv += "k,1,soft,0.3,0.2,0.05,70\nk,,,0.3,0.2,0.05,70\n";
  const Json json = Json::parse(repose({"fit", write_table(folder, csv), "--json"}).out);
  EXPECT_EQ(json.at("points"), 6);
  EXPECT_EQ(json.at("excluded").at(0).at("reason"), "rung of a chart: soft");
  EXPECT_EQ(json.at("excluded").at(1).at("reason"), "not in the study's design any more");
}

TEST(Fit, AnglesAndRestitutionsThatCannotBeAreLeftOut) {
  const TemporaryFolder folder;
  const std::string table =
      write_table(folder, article_table() + "28,0.3,0.5,0.1,120,red\n29,3,0.5,0.1,30,red\n");
  const Json json = Json::parse(repose({"fit", table, "--json"}).out);
  EXPECT_EQ(json.at("points"), 27);
  EXPECT_EQ(json.at("excluded").at(0).at("reason"), "angle = 120 deg: must be < 90");
  EXPECT_EQ(json.at("excluded").at(1).at("reason"), "e_pp = 3: must be <= 1");
}

/// 0.1 + 0.2 is 0.3 in a spreadsheet's eyes: such rows are repeats of one point.
TEST(Fit, ValuesThatDifferByRoundingAreOneSetting) {
  const TemporaryFolder folder;
  std::string csv = "e_pp,mu_s,mu_r,angle_deg\n";
  for (const char* mu_s : {"0.3", "0.30000000000000004", "0.6", "0.6000000000000001"})
    for (const char* mu_r : {"0.05", "0.2"})
      csv += fmt::format("0.3,{},{},{}\n", mu_s, mu_r, 20 + csv.size() % 7);
  const Json json = Json::parse(repose({"fit", write_table(folder, csv), "--json"}).out);
  EXPECT_EQ(json.at("points"), 8);
  EXPECT_EQ(json.at("distinct_points"), 4);
}

TEST(Fit, ReadsATableFromAPipe) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Process writer("/bin/sh", {"-c", "cat \"$0\" > \"$1\"", table, pipe.string()});
  const Finished run = repose({"fit", pipe.string(), "--json"});
  EXPECT_EQ(writer.wait().code, 0);
  EXPECT_EQ(Json::parse(run.out).at("points"), 27) << run.err;
}

struct BadTable {
  std::string csv;
  std::vector<std::string> messages;
};

TEST(Fit, EveryFaultOfATableIsNamedWithItsLine) {
  const std::vector<BadTable> tables = {
      {"", {"no header"}},
      {"e_pp,mu_s,mu_r,angle_deg\n", {"no rows"}},
      {"e_pp,mu_r,angle\n0.1,0.2,30\n", {"mu_s", "angle_deg", "missing"}},
      {"e_pp,mu_s,mu_r,angle_deg\n0.1,zero,0.2,30\n0.1,0.3,,30\n0.1,0.3,0.1,steep\n",
       {"line 2", "zero", "line 3", "mu_r", "line 4", "steep"}},
      {"e_pp,mu_s,mu_r,angle_deg\n0.1,0.2,0.3\n0.1,0.2,0.3,30,7\n", {"line 2", "line 3"}},
      {"e_pp,mu_s,mu_r,angle_deg\n0.1,0.2,0.3\n0.1,zero,0.3,30\n", {"line 2", "line 3", "zero"}},
      {"e_pp,mu_s,mu_r,angle_deg,replicate\n0.1,0.2,0.3,30,1.5\n", {"line 2", "replicate", "1.5"}},
      {"e_pp,mu_s,mu_s,mu_r,angle_deg\n1,1,1,1,1\n", {"twice"}},
      {"e_pp,mu_s,mu_r,angle_deg\n0.3,0.2,0.1,30\n0.3,0.4,0.1,33\n", {"points"}},
      {"e_pp,mu_s,mu_r,angle_deg\n0.3,0.2,0.1,\n", {"no angle"}},
  };
  for (const BadTable& bad : tables) {
    const TemporaryFolder folder;
    const Finished run = repose({"fit", write_table(folder, bad.csv)});
    EXPECT_EQ(run.code, 2) << bad.csv;
    EXPECT_EQ(run.out, "") << bad.csv;
    for (const std::string& message : bad.messages)
      EXPECT_NE(run.err.find(message), std::string::npos) << message << " in\n" << run.err;
  }
}

TEST(Fit, AMissingTableAndASavedFitAreFaults) {
  const TemporaryFolder folder;
  const std::string nothing = (folder / "nothing.csv").string();
  const Finished missing = repose({"fit", nothing});
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find(nothing), std::string::npos);
  write_text(folder / "fit.json", repose({"fit", write_table(folder, article_table()), "--json"}).out);
  EXPECT_EQ(repose({"fit", (folder / "fit.json").string()}).code, 2);
}

TEST(Invert, FindsTheFrictionThatATableWasMadeFrom) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  const double angle = article_angle(0.3, 0.45, 0.12);
  const Finished run = repose({"invert", table, "--angle", fmt::format("{:.17g}", angle), "--fix",
                               "mu_r=0.12", "e_pp=0.3", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  // dμs/μs = dα/(c α), so that 1e-6 in the exponents is about 1e-5 in μs.
  EXPECT_NEAR(json.at("solution").at("mu_s").get<double>(), 0.45, 0.45e-5);
  EXPECT_EQ(json.at("identifiable"), true);
}

TEST(Invert, LevelSetGivesTheAngleEverywhereAndStaysInTheDomain) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  const Finished run =
      repose({"invert", table, "--angle", "38", "--sigma", "1", "--fix", "e_pp=0.3", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_GE(json.at("level_set").size(), 2U);
  for (const Json& at : json.at("level_set")) {
    const double mu_s = at.at("mu_s");
    const double mu_r = at.at("mu_r");
    EXPECT_NEAR(article_angle(0.3, mu_s, mu_r), 38.0, 1e-3);
    EXPECT_GE(mu_s, 0.2 * (1.0 - 1e-12));
    EXPECT_LE(mu_s, 0.8 * (1.0 + 1e-12));
    EXPECT_LE(at.at("mu_s_band").at(0).get<double>(), mu_s);
    EXPECT_GE(at.at("mu_s_band").at(1).get<double>(), mu_s);
  }
  EXPECT_EQ(json.at("identifiable"), false) << "one angle does not fix two values";
}

TEST(Invert, ASavedFitGivesWhatItsTableGives) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  write_text(folder / "fit.json", repose({"fit", table, "--json"}).out);
  const std::vector<std::string> question = {"--angle", "36",       "--sigma", "0.5",
                                             "--fix",   "mu_r=0.1", "--json"};
  const auto solution_of = [&](const std::string& source) {
    std::vector<std::string> arguments = {"invert", source};
    arguments.insert(arguments.end(), question.begin(), question.end());
    const Finished run = repose(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out).at("solution").at("mu_s").get<double>();
  };
  const double from_table = solution_of(table);
  EXPECT_NEAR(solution_of((folder / "fit.json").string()), from_table, 1e-12 * from_table);
}

TEST(Invert, ASavedFitKeepsTheLossThatItWasMadeWith) {
  const TemporaryFolder folder;
  const fs::path file = folder / "fit.json";
  write_text(file, repose({"fit", write_table(folder, article_table()), "--json"}).out);
  const auto inverted = [&](const char* loss) {
    return repose({"invert", file.string(), "--angle", "36", "--fix", "mu_r=0.1", "--loss", loss});
  };
  EXPECT_EQ(inverted("least-squares").code, 0);
  const Finished other = inverted("minimax");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("--loss: minimax"), std::string::npos) << other.err;
}

/// Errors that are not known are not zero: the answer says what its intervals leave out.
TEST(Invert, ASavedFitWithoutErrorsSaysSo) {
  const TemporaryFolder folder;
  const fs::path file = folder / "fit.json";
  write_text(file, R"({"C": 56.61, "a": 0.01, "b": 0.084, "c": 0.25,
    "domain": {"e_pp": [0.1, 0.6], "mu_s": [0.1, 0.8], "mu_r": [0.02, 0.2]}})");
  const std::vector<std::string> question = {"invert", file.string(), "--angle", "30", "--fix", "mu_r=0.1"};
  const Finished words = repose(question);
  EXPECT_EQ(words.code, 0) << words.err;
  EXPECT_NE(words.out.find("gives no covariance"), std::string::npos) << words.out;
  EXPECT_EQ(words.out.find("equation's own error"), std::string::npos) << words.out;
  std::vector<std::string> as_json = question;
  as_json.emplace_back("--json");
  EXPECT_TRUE(Json::parse(repose(as_json).out).contains("remark"));
}

TEST(Invert, FaultsOfASavedFitAreSaidOneByOneToPrograms) {
  const TemporaryFolder folder;
  const fs::path file = folder / "fit.json";
  write_text(file, R"({"C": -1, "a": 0.01, "c": 0.25, "domain": {"mu_s": [0.1, 0.8], "mu_r": [0.02, 0.2]}})");
  const Finished run = repose({"invert", file.string(), "--angle", "30", "--json"});
  EXPECT_EQ(run.code, 2);
  const Json faults = Json::parse(run.out).at("faults");
  ASSERT_EQ(faults.size(), 3U) << run.out;
  EXPECT_EQ(faults[0].at("pointer"), "/b");
  EXPECT_EQ(faults[1],
            Json({{"file", file.string()}, {"pointer", "/C"}, {"value", "-1"}, {"rule", "must be > 0"}}));
  EXPECT_EQ(faults[2].at("pointer"), "/domain/e_pp");
}

TEST(Invert, ABadQuestionAndABadSourceAreSaidTogether) {
  const Finished run = repose({"invert", "missing.csv", "--angle", "95"});
  EXPECT_EQ(run.code, 2);
  for (const char* word : {"--angle: 95", "missing.csv"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
}

TEST(Invert, AnAngleOutOfReachNamesTheReachableRange) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  const Finished run = repose({"invert", table, "--angle", "60", "--fix", "e_pp=0.3", "--json"});
  EXPECT_EQ(run.code, 2);
  const Json json = Json::parse(run.out);
  EXPECT_NEAR(json.at("reachable_deg").at(0).get<double>(), article_angle(0.3, 0.2, 0.05), 1e-3);
  EXPECT_NEAR(json.at("reachable_deg").at(1).get<double>(), article_angle(0.3, 0.8, 0.2), 1e-3);
  EXPECT_NE(run.err.find("46."), std::string::npos) << "the upper end, 46.4°, in words: " << run.err;
}

TEST(Invert, BadQuestionsAreRefusedWhole) {
  const TemporaryFolder folder;
  const std::string table = write_table(folder, article_table());
  const Finished run =
      repose({"invert", table, "--angle", "-5", "--sigma", "-1", "--fix", "mu_q=1", "mu_r", "mu_s=a"});
  EXPECT_EQ(run.code, 2);
  for (const std::string word : {"--angle", "--sigma", "mu_q=1", "--fix: mu_r:", "mu_s=a"})
    EXPECT_NE(run.err.find(word), std::string::npos) << word << " in\n" << run.err;
  for (const std::string outside : {"mu_r=0.5", "e_pp=0.99"}) {
    const Finished refused = repose({"invert", table, "--angle", "35", "--fix", outside});
    EXPECT_EQ(refused.code, 2) << outside << refused.out;
  }
}

}  // namespace
}  // namespace repose::test
