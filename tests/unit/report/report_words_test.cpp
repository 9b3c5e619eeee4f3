#include <gtest/gtest.h>

#include "unit/report/report_fixture.hpp"

namespace repose::report {
namespace {

using test::full_report;
using test::report_of;
using test::table;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string answer(const fit::PowerLaw& law, const fit::Question& question) {
  std::string text;
  for (const std::string& p : answer_paragraphs(law, fit::invert(law, question), "study")) text += p + "\n";
  return text;
}

TEST(AnswerInWords, DescribesTheCurveAndWhatToFixNext) {
  const fit::PowerLaw law = *full_report().law;
  const fit::Question question{.angle = 35.0, .sigma = 1.0};
  const std::string text = answer(law, question);
  const fit::Inversion inversion = fit::invert(law, question);
  char middle[80];
  const fit::LevelPoint& half = inversion.level_set[20];
  std::snprintf(middle, sizeof middle, "Half-way lies μs = %.3g with μr = %.3g;", half.mu_s, half.mu_r);
  EXPECT_TRUE(says(text, "A measured angle of 35° ± 1° is met by a whole curve"));
  EXPECT_TRUE(says(text, middle)) << text;
  EXPECT_TRUE(says(text, "Fix μr next"));
  EXPECT_TRUE(says(text, "\n  repose invert study --angle 35 --sigma 1 --fix mu_r=0.1\n")) << text;
}

TEST(AnswerInWords, ProposesACommandThatWorks) {
  const fit::PowerLaw law = *full_report().law;
  const fit::Inversion inversion = fit::invert(law, {.angle = 35.0, .sigma = 1.0, .e = 0.2});
  const auto paragraphs = answer_paragraphs(law, inversion, "study");
  EXPECT_TRUE(says(paragraphs[2], " --fix e_pp=0.2 --fix mu_r=")) << paragraphs[2];
  const double mu_r = std::stod(paragraphs[2].substr(paragraphs[2].find("mu_r=") + 5));
  EXPECT_NO_THROW(fit::invert(law, {.angle = 35.0, .sigma = 1.0, .e = 0.2, .mu_r = mu_r}));
}

TEST(AnswerInWords, QuotesAFolderForTheShellWhereItNeedsIt) {
  const fit::PowerLaw law = *full_report().law;
  const fit::Inversion inversion = fit::invert(law, {.angle = 35.0});
  const auto command = [&](const std::string& source) {
    return answer_paragraphs(law, inversion, source)[2];
  };
  EXPECT_TRUE(says(command("runs/ore_1"), "repose invert runs/ore_1 --angle"));
  EXPECT_TRUE(says(command("my ore's"), "repose invert 'my ore'\\''s' --angle")) << command("my ore's");
}

TEST(AnswerInWords, GivesTheValueWhereTheRestIsFixed) {
  const fit::PowerLaw law = *full_report().law;
  const fit::Question question{.angle = 35.0, .sigma = 1.0, .mu_r = 0.1};
  const fit::Solution solution = *fit::invert(law, question).solution;
  char value[120];
  std::snprintf(value, sizeof value, "gives μs = %.3g, with 95 %% confidence between %.3g and %.3g.",
                solution.value.mu_s, solution.low.mu_s, solution.high.mu_s);
  EXPECT_TRUE(says(answer(law, question), value)) << answer(law, question);
  EXPECT_FALSE(says(answer(law, question), "Fix "));
}

TEST(AnswerInWords, SaysThatAnIntervalIsCut) {
  const fit::PowerLaw law = *full_report().law;
  EXPECT_TRUE(
      says(answer(law, {.angle = 35.0, .sigma = 1.0, .mu_s = 0.3}), "cut by the edge of the values swept"));
}

TEST(AnswerInWords, GivesNoValueThatTheRunsDoNotShow) {
  std::vector<fit::Observation> rows = table({0.3}, {0.05, 0.1, 0.2});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].angle = 50.0 * std::pow(rows[i].mu_s, 0.25) + 6.0 * std::sin(9.0 * static_cast<double>(i));
  }
  const fit::PowerLaw law = fit::fit_power_law(rows);
  const double angle = law.predict({0.3, 0.4, 0.1});
  const std::string text = answer(law, {.angle = angle, .sigma = 1.0, .mu_s = 0.4});
  EXPECT_TRUE(says(text, "does not fix μr: over the values swept the angle does not depend on it")) << text;
}

TEST(AnswerInWords, GivesNoCurveThatTheRunsDoNotShow) {
  fit::PowerLaw law = *full_report().law;
  for (fit::Estimate* exponent : {&law.b, &law.c}) exponent->interval_95 = {-0.1, exponent->value + 0.1};
  const std::string text = answer(law, {.angle = 35.0});
  EXPECT_TRUE(says(text, "A measured angle of 35° fixes neither friction")) << text;
  EXPECT_FALSE(says(text, "whole curve"));
  EXPECT_FALSE(says(text, "repose invert")) << text;
}

TEST(AnswerInWords, DoesNotMindALawWithoutErrorsOfItsOwn) {
  fit::PowerLaw law = *full_report().law;
  law.a.value = 1e-4;
  law.worst_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(answer(law, {.angle = 35.0, .sigma = 1.0}), "restitution need not be known well"));
}

TEST(AnswerInWords, NamesTheLargerPartOfTheBand) {
  const fit::PowerLaw law = *full_report().law;  // its scatter is about 0.3°
  EXPECT_TRUE(
      says(answer(law, {.angle = 35.0, .sigma = 2.0}), "Most of the band comes from the measured angle (2°"));
  EXPECT_TRUE(says(answer(law, {.angle = 35.0, .sigma = 0.1}), "Most of the band comes from the equation"));
  EXPECT_TRUE(says(answer(law, {.angle = 35.0}), "No error of the measured angle was given"));
}

TEST(AnswerInWords, SaysWhatRestitutionDoes) {
  EXPECT_TRUE(
      says(answer(*full_report().law, {.angle = 35.0, .sigma = 1.0}), "restitution need not be known well"));
  const fit::PowerLaw held = fit::fit_power_law(table({0.3}, {0.05, 0.1, 0.2}));
  EXPECT_TRUE(says(answer(held, {.angle = 35.0}), "Restitution was 0.3 in every run"));
  std::vector<fit::Observation> rows = table({0.1, 0.3, 0.5}, {0.05, 0.1, 0.2});
  for (fit::Observation& row : rows) row.angle *= std::pow(row.e, -0.2);
  EXPECT_TRUE(says(answer(fit::fit_power_law(rows), {.angle = 42.0}), "restitution matters here"));
}

TEST(AnswerInWords, CountsTheRunsLeftOutByReason) {
  std::vector<fit::Observation> rows = table({0.3}, {0.05, 0.1, 0.2});
  rows[0].exclusion = "no_heap";
  EXPECT_TRUE(says(answer(fit::fit_power_law(rows), {.angle = 35.0}), "One run is left out: no_heap."));
  rows[1].exclusion = "no_heap";
  rows[2].exclusion = "timed_out";
  EXPECT_TRUE(says(answer(fit::fit_power_law(rows), {.angle = 35.0}),
                   "3 runs are left out: 2 × no_heap; 1 × timed_out."));
}

TEST(AnswerInWords, BreaksLinesForATerminalButNotCommands) {
  const fit::PowerLaw law = *full_report().law;
  const fit::Inversion inversion = fit::invert(law, {.angle = 35.0, .sigma = 1.0});
  const std::string source(120, 's');
  const std::string text = answer_in_words(law, inversion, source);
  std::size_t begin = 0;
  int commands = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("  repose invert " + source)) {
      ++commands;
      continue;
    }
    const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    EXPECT_LE(columns, 100) << line;
  }
  EXPECT_EQ(commands, 1);
}

TEST(EquationInWords, LeavesOutFactorsThatStandStill) {
  fit::PowerLaw law;
  law.C.value = 56.61;
  law.a = {0.01, 0.001, {}, true};
  law.b = {0.084, 0.001, {}, true};
  law.c = {0.25, 0.001, {}, true};
  EXPECT_EQ(equation_in_words(law), "α = 56.61 e^0.01 μr^0.084 μs^0.25");
  law.a.identified = false;
  EXPECT_EQ(equation_in_words(law), "α = 56.61 μr^0.084 μs^0.25");
}

}  // namespace
}  // namespace repose::report
