#include "fit/inversion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/fit/tables.hpp"

namespace repose::fit {
namespace {

using test::article_angle;
using test::article_table;
using test::Noise;

PowerLaw noisy_law(std::uint64_t seed, double deviation = 1.0) {
  Noise noise(seed);
  std::vector<Observation> table = article_table();
  for (Observation& row : table) row.angle += deviation * noise.normal();
  return fit_power_law(table);
}

std::string inversion_message(const PowerLaw& law, const Question& question) {
  try {
    invert(law, question);
  } catch (const Unusable& error) {
    return error.what();
  }
  return "solved";
}

// Tolerance 1e-9 relative throughout: the inverse of an equation fitted to rounding.
TEST(Inversion, EveryPointOfTheCurveGivesTheAngle) {
  const PowerLaw law = fit_power_law(article_table());
  const Inversion answer = invert(law, {.angle = 33.0, .sigma = 1.0});
  ASSERT_EQ(answer.level_set.size(), 41U);
  EXPECT_NEAR(answer.e, std::sqrt(0.1 * 0.5), 1e-12);
  EXPECT_FALSE(answer.e_is_given);
  for (const LevelPoint& point : answer.level_set) {
    EXPECT_NEAR(article_angle(answer.e, point.mu_s, point.mu_r), 33.0, 33e-9);
    EXPECT_GE(point.mu_s, 0.2);
    EXPECT_LE(point.mu_s, 0.8);
    EXPECT_GE(point.mu_r, 0.05);
    EXPECT_LE(point.mu_r, 0.2);
  }
  EXPECT_FALSE(answer.identifiable);
  EXPECT_FALSE(answer.solution.has_value());
}

TEST(Inversion, TheCurveRunsFromEdgeToEdgeOfTheDomain) {
  const PowerLaw law = fit_power_law(article_table());
  const Inversion answer = invert(law, {.angle = 36.0});
  const auto on_edge = [](const LevelPoint& p) {
    const auto near = [](double x, double y) { return std::abs(x - y) < 1e-9; };
    return near(p.mu_s, 0.2) || near(p.mu_s, 0.8) || near(p.mu_r, 0.05) || near(p.mu_r, 0.2);
  };
  EXPECT_TRUE(on_edge(answer.level_set.front()));
  EXPECT_TRUE(on_edge(answer.level_set.back()));
  EXPECT_LT(answer.level_set.front().mu_s, answer.level_set.back().mu_s);
}

TEST(Inversion, GoesThereAndBack) {
  const PowerLaw law = fit_power_law(article_table());
  for (const double e : {0.1, 0.17, 0.5}) {
    for (const double mu_s : {0.2, 0.33, 0.8}) {
      for (const double mu_r : {0.05, 0.11, 0.2}) {
        Question question{.angle = article_angle(e, mu_s, mu_r), .sigma = 0.0, .e = e, .mu_r = mu_r};
        const Inversion sliding = invert(law, question);
        EXPECT_NEAR(sliding.solution->value.mu_s, mu_s, 1e-9);
        EXPECT_TRUE(sliding.identifiable);
        EXPECT_TRUE(sliding.solution->solved_mu_s);
        question.mu_r.reset();
        question.mu_s = mu_s;
        const Inversion rolling = invert(law, question);
        EXPECT_NEAR(rolling.solution->value.mu_r, mu_r, 1e-8);
        EXPECT_FALSE(rolling.solution->solved_mu_s);
      }
    }
  }
}

// Without error of the fit the band is that of the measured angle alone: α ± 1.96 σ, solved in logarithms.
TEST(Inversion, AnExactEquationPassesTheErrorOfTheAngleOn) {
  const PowerLaw law = fit_power_law(article_table());
  const Inversion answer = invert(law, {.angle = 33.0, .sigma = 0.5, .mu_r = 0.1});
  const double ratio = std::exp(1.959963985 * 0.5 / 33.0 / test::kExponentS);
  const Solution& solution = *answer.solution;
  EXPECT_NEAR(solution.high.mu_s / solution.value.mu_s, ratio, 1e-6);
  EXPECT_NEAR(solution.value.mu_s / solution.low.mu_s, ratio, 1e-6);
  EXPECT_EQ(solution.low.mu_r, 0.1);
  EXPECT_FALSE(solution.reaches_the_edge);
  EXPECT_EQ(solution.value.e, answer.e);
}

// The material is a new draw: law + scatter of one simulated angle + error of measurement. 500 repeats have a
// binomial deviation of 0.97 %; accepted within 3.5 of them.
TEST(Inversion, IntervalsCoverTheTrueFrictionInNineteenOfTwenty) {
  Noise noise(404);
  int covered = 0;
  const double truth = article_angle(std::sqrt(0.05), 0.4, 0.1);
  for (int repeat = 0; repeat < 500; ++repeat) {
    std::vector<Observation> table = article_table();
    for (Observation& row : table) row.angle += 0.4 * noise.normal();
    const double angle = truth + 0.4 * noise.normal() + 0.5 * noise.normal();
    const Inversion answer = invert(fit_power_law(table), {.angle = angle, .sigma = 0.5, .mu_r = 0.1});
    covered += answer.solution->low.mu_s <= 0.4 && 0.4 <= answer.solution->high.mu_s ? 1 : 0;
  }
  EXPECT_NEAR(covered / 500.0, 0.95, 3.5 * 0.0097);
}

TEST(Inversion, TheBandWidensWithTheErrorOfTheAngleAndOfTheFit) {
  const auto width = [](const PowerLaw& law, double sigma) {
    const Solution solution = *invert(law, {.angle = 33.0, .sigma = sigma, .mu_r = 0.1}).solution;
    return solution.high.mu_s - solution.low.mu_s;
  };
  const PowerLaw good = noisy_law(1, 0.2);
  const PowerLaw poor = noisy_law(1, 0.6);
  EXPECT_GT(width(good, 0.0), 0.0);
  EXPECT_GT(width(good, 0.5), width(good, 0.0));
  EXPECT_GT(width(poor, 0.5), width(good, 0.5));
}

// With one degree of freedom as with many: σ is known, whatever is not.
TEST(Inversion, ALargerErrorOfTheAngleNeverNarrowsTheBandNorFixesWhatWasNotFixed) {
  const auto row = [](double mu_s, double angle) {
    Observation one{0.3, mu_s, 0.1};
    one.angle = angle;
    return one;
  };
  const PowerLaw steep =
      fit_power_law(std::vector<Observation>{row(0.2, 40.2), row(0.4, 47.0), row(0.8, 56.6)});
  ASSERT_EQ(steep.error.degrees_of_freedom, 1.0);
  double width = 0.0;
  for (const double sigma : {0.0, 0.1, 0.3, 1.0, 3.0}) {
    const Solution solution = *invert(steep, {.angle = 47.0, .sigma = sigma}).solution;
    EXPECT_GE(solution.high.mu_s - solution.low.mu_s, width) << sigma;
    width = solution.high.mu_s - solution.low.mu_s;
  }
  const PowerLaw flat =
      fit_power_law(std::vector<Observation>{row(0.2, 30.5), row(0.4, 33.0), row(0.6, 31.0), row(0.8, 32.5)});
  for (const double sigma : {0.0, 1.0, 3.0, 10.0})
    EXPECT_FALSE(invert(flat, {.angle = 31.8, .sigma = sigma}).identifiable) << sigma;
}

TEST(Inversion, SaysThatAnEquationWithoutFrictionHasNoCurve) {
  PowerLaw law = fit_power_law(test::article_table());
  law.b.value = law.c.value = 0.0;
  EXPECT_THROW(invert(law, {.angle = 30.0}), Unusable);
}

TEST(Inversion, BandsHoldTheirCurveAndStayInTheDomain) {
  const PowerLaw law = noisy_law(2);
  const Inversion answer = invert(law, {.angle = 33.0, .sigma = 1.0});
  for (const LevelPoint& point : answer.level_set) {
    EXPECT_LE(point.mu_s_band.low, point.mu_s);
    EXPECT_GE(point.mu_s_band.high, point.mu_s);
    EXPECT_LE(point.mu_r_band.low, point.mu_r);
    EXPECT_GE(point.mu_r_band.high, point.mu_r);
    EXPECT_GE(point.mu_s_band.low, law.domain.mu_s.low);
    EXPECT_LE(point.mu_s_band.high, law.domain.mu_s.high);
    EXPECT_GE(point.mu_r_band.low, law.domain.mu_r.low);
    EXPECT_LE(point.mu_r_band.high, law.domain.mu_r.high);
  }
  ASSERT_FALSE(answer.band.empty());
  for (const BandRow& row : answer.band) EXPECT_LE(row.mu_s.low, row.mu_s.high);
}

TEST(Inversion, NamesTheReachableRangeOfAnAngleOutOfReach) {
  const PowerLaw law = fit_power_law(article_table());
  const double e = std::sqrt(0.05);
  try {
    invert(law, {.angle = 50.0});
    FAIL() << "50 deg is out of reach";
  } catch (const Unreachable& error) {
    EXPECT_NEAR(error.reachable().low, article_angle(e, 0.2, 0.05), 1e-9);
    EXPECT_NEAR(error.reachable().high, article_angle(e, 0.8, 0.2), 1e-9);
    EXPECT_STREQ(error.what(),
                 "angle = 50 deg cannot be reached: the equation gives 29.00 ... 46.07 deg over the domain "
                 "(e_pp = 0.2236, mu_s = 0.2 ... 0.8, mu_r = 0.05 ... 0.2); widen the sweep");
  }
  // With μr held the range is narrower.
  EXPECT_NO_THROW(invert(law, {.angle = 44.0}));
  try {
    invert(law, {.angle = 44.0, .mu_r = 0.05});
    FAIL() << "44 deg is out of reach at mu_r = 0.05";
  } catch (const Unreachable& error) {
    EXPECT_NEAR(error.reachable().high, article_angle(e, 0.8, 0.05), 1e-9);
    EXPECT_NE(std::string(error.what()).find("mu_r = 0.05)"), std::string::npos);
  }
}

TEST(Inversion, ReachesTheCornersOfTheDomain) {
  const PowerLaw law = fit_power_law(article_table());
  for (const auto& [mu_s, mu_r] : {std::pair{0.2, 0.05}, std::pair{0.8, 0.2}}) {
    const Inversion answer = invert(law, {.angle = article_angle(0.3, mu_s, mu_r), .e = 0.3});
    for (const LevelPoint& point : answer.level_set) {
      EXPECT_NEAR(point.mu_s, mu_s, 1e-7);
      EXPECT_NEAR(point.mu_r, mu_r, 1e-7);
    }
  }
}

TEST(Inversion, RejectsEveryFaultOfAQuestionAtOnce) {
  const PowerLaw law = fit_power_law(article_table());
  EXPECT_EQ(inversion_message(law, {.angle = 95.0, .sigma = -1.0, .e = 0.9, .mu_r = 0.01}),
            "angle = 95 deg: must be > 0 and < 90\n"
            "sigma = -1 deg: must be >= 0\n"
            "e_pp = 0.9: outside the domain of the fit, 0.1 ... 0.5\n"
            "mu_r = 0.01: outside the domain of the fit, 0.05 ... 0.2");
  EXPECT_EQ(inversion_message(law, {.angle = 33.0, .mu_s = 0.4, .mu_r = 0.1}),
            "mu_s and mu_r are both fixed: nothing is left to solve for");
  EXPECT_EQ(inversion_message(law, {.angle = std::nan(""), .mu_s = std::nan("")}),
            "angle = nan deg: must be > 0 and < 90\n"
            "mu_s = nan: outside the domain of the fit, 0.2 ... 0.8");
}

TEST(Inversion, SolvesForTheOnlyFrictionThatWasSwept) {
  std::vector<Observation> table;
  for (const Observation& row : article_table()) {
    if (row.mu_r == 0.1) table.push_back(row);
  }
  const PowerLaw law = fit_power_law(table);
  const Inversion answer = invert(law, {.angle = article_angle(0.3, 0.5, 0.1), .e = 0.3});
  EXPECT_NEAR(answer.solution->value.mu_s, 0.5, 1e-9);
  EXPECT_EQ(answer.solution->value.mu_r, 0.1);
  EXPECT_TRUE(answer.identifiable);
  EXPECT_EQ(answer.level_set.size(), 1U);
  EXPECT_EQ(inversion_message(law, {.angle = 33.0, .mu_s = 0.3}),
            "mu_s and mu_r are both fixed: nothing is left to solve for");
}

TEST(Inversion, NeedsAFrictionThatWasSwept) {
  std::vector<Observation> table;
  for (const Observation& row : article_table()) {
    if (row.mu_r == 0.1 && row.mu_s == 0.4) table.push_back(row);
  }
  EXPECT_EQ(inversion_message(fit_power_law(table), {.angle = 33.0}),
            "neither mu_s nor mu_r varies in the table: there is no friction to solve for");
}

// Scatter of 8° over a table whose angle hardly depends on μr: no μr can be named, and the answer says so.
TEST(Inversion, ADependenceLostInTheScatterIsNotIdentifiable) {
  Noise noise(12);
  std::vector<Observation> table = article_table();
  for (Observation& row : table) row.angle = article_angle(0.3, row.mu_s, 0.1) + 8.0 * noise.normal();
  const PowerLaw law = fit_power_law(table);
  ASSERT_LT(law.b.interval_95.low * law.b.interval_95.high, 0.0);
  const double within = law.predict({std::sqrt(0.05), 0.4, 0.1});
  const Inversion answer = invert(law, {.angle = within, .sigma = 1.0, .mu_s = 0.4});
  EXPECT_FALSE(answer.identifiable);
  EXPECT_TRUE(answer.solution->reaches_the_edge);
  EXPECT_EQ(answer.solution->low.mu_r, 0.05);
  EXPECT_EQ(answer.solution->high.mu_r, 0.2);
}

TEST(Inversion, SaysHowLittleRestitutionMatters) {
  const PowerLaw law = fit_power_law(article_table());
  const Inversion answer = invert(law, {.angle = 33.0});
  const double expected = 33.0 * (std::pow(0.5 / answer.e, 0.01) - std::pow(0.1 / answer.e, 0.01));
  EXPECT_NEAR(answer.restitution_effect, expected, 1e-9);
}

}  // namespace
}  // namespace repose::fit
