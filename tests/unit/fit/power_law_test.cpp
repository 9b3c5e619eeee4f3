#include "fit/power_law.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "unit/fit/tables.hpp"

namespace repose::fit {
namespace {

using test::article_angle;
using test::article_table;
using test::Noise;

std::string fit_message(const std::vector<Observation>& table) {
  try {
    fit_power_law(table);
  } catch (const Unusable& error) {
    return error.what();
  }
  return "fitted";
}

std::vector<Observation> noisy(std::vector<Observation> table, Noise& noise, double deviation) {
  for (Observation& row : table) row.angle += deviation * noise.normal();
  return table;
}

// Tolerance: rounding of angles near 30 (4e-15 relative), enlarged by the condition of the design.
TEST(PowerLawFit, RecoversTheArticlesEquationExactly) {
  const PowerLaw law = fit_power_law(article_table());
  EXPECT_NEAR(law.C.value, test::kC, 1e-11);
  EXPECT_NEAR(law.a.value, test::kA, 1e-13);
  EXPECT_NEAR(law.b.value, test::kB, 1e-13);
  EXPECT_NEAR(law.c.value, test::kExponentS, 1e-13);
  EXPECT_LT(law.worst_error, 1e-12);
  EXPECT_NEAR(law.r_squared, 1.0, 1e-14);
  EXPECT_EQ(law.points, 27);
  EXPECT_EQ(law.distinct_points, 27);
  EXPECT_TRUE(law.excluded.empty());
  EXPECT_EQ(law.domain.mu_s.low, 0.2);
  EXPECT_EQ(law.domain.mu_s.high, 0.8);
  EXPECT_EQ(law.domain.angle.high, article_angle(0.5, 0.8, 0.2));
}

TEST(PowerLawFit, MinimisesDegreesAndNotTheirLogarithm) {
  Noise noise(8);
  const std::vector<Observation> table = noisy(article_table(), noise, 3.0);
  const PowerLaw law = fit_power_law(table);
  const auto sum = [&table](double C, double a, double b, double c) {
    double total = 0.0;
    for (const Observation& row : table) {
      const double angle = C * std::pow(row.e, a) * std::pow(row.mu_r, b) * std::pow(row.mu_s, c);
      total += std::pow(angle - row.angle, 2);
    }
    return total;
  };
  // A step of any parameter, either way, makes the sum of squares larger.
  const double best = sum(law.C.value, law.a.value, law.b.value, law.c.value);
  for (const double step : {-1e-5, 1e-5}) {
    EXPECT_GT(sum(law.C.value * (1 + step), law.a.value, law.b.value, law.c.value), best);
    EXPECT_GT(sum(law.C.value, law.a.value + step, law.b.value, law.c.value), best);
    EXPECT_GT(sum(law.C.value, law.a.value, law.b.value + step, law.c.value), best);
    EXPECT_GT(sum(law.C.value, law.a.value, law.b.value, law.c.value + step), best);
  }
  EXPECT_NEAR(law.rms_error, std::sqrt(best / 27.0), 1e-12);
}

TEST(PowerLawFit, NamesTheWorstPoint) {
  std::vector<Observation> table = article_table();
  table[14].angle += 4.0;
  table[14].label = "run 14";
  const PowerLaw law = fit_power_law(table);
  EXPECT_EQ(law.worst_point.label, "run 14");
  EXPECT_NEAR(law.worst_error, std::abs(law.predict(factors_of(table[14])) - table[14].angle), 1e-12);
  EXPECT_GT(law.worst_error, 3.0);
}

// 500 tables: a rate of 95 % has a binomial deviation of 0.97 %; accepted within 3.5 of them.
TEST(PowerLawFit, IntervalsCoverTheTruthInNineteenOfTwenty) {
  Noise noise(2017);
  std::array<int, 4> covered{};
  for (int repeat = 0; repeat < 500; ++repeat) {
    const PowerLaw law = fit_power_law(noisy(article_table(), noise, 1.0));
    const std::array<double, 4> truth = {test::kC, test::kA, test::kB, test::kExponentS};
    for (std::size_t k = 0; k < 4; ++k) {
      const Range& interval = law.parameters()[k]->interval_95;
      covered[k] += interval.low <= truth[k] && truth[k] <= interval.high ? 1 : 0;
    }
  }
  for (const int count : covered) EXPECT_NEAR(count / 500.0, 0.95, 3.5 * 0.0097);
}

/// Every point is off the law by its own normal error of `misfit` that its repeats share; `repeats` by the
/// number of the point.
std::vector<Observation> missed(Noise& noise, double misfit, double own, auto repeats) {
  std::vector<Observation> table;
  int number = 0;
  for (const Observation& point : article_table()) {
    const double shared = misfit * noise.normal();
    for (int k = 0; k < repeats(number); ++k) {
      table.push_back(point);
      table.back().replicate = k;
      table.back().angle += shared + own * noise.normal();
    }
    ++number;
  }
  return table;
}

// Every point is off the law by an error of its own (1°) that its five repeats (0.3°) share: intervals that
// took the repeats for independent would cover in 60 %. Tolerance as above.
TEST(PowerLawFit, RepeatsDoNotHideALackOfFit) {
  Noise noise(77);
  int covered = 0;
  for (int repeat = 0; repeat < 500; ++repeat) {
    const PowerLaw law = fit_power_law(missed(noise, 1.0, 0.3, [](int) { return 5; }));
    EXPECT_EQ(law.error.degrees_of_freedom, 23.0);
    EXPECT_LT(law.error.lack_of_fit_p, 0.05);
    covered += std::abs(law.c.value - test::kExponentS) < law.c.interval_95.high - law.c.value ? 1 : 0;
  }
  EXPECT_NEAR(covered / 500.0, 0.95, 3.5 * 0.0097);
}

TEST(PowerLawFit, RepeatsGiveThePureErrorAndAreUsedWhereTheLawHolds) {
  Noise noise(4);
  const PowerLaw law = fit_power_law(noisy(article_table(20), noise, 0.5));
  // Deviation of a standard deviation over 513 degrees of freedom: 0.5/√1026 = 0.016; accepted within 4.
  EXPECT_NEAR(law.error.pure_error, 0.5, 0.063);
  EXPECT_GT(law.error.lack_of_fit_p, 0.25);
  EXPECT_EQ(law.error.degrees_of_freedom, 540.0 - 4.0);
  EXPECT_EQ(law.distinct_points, 27);
}

// One new angle is off by √(τ² + σ²), however many repeats there were; their mean is off by less. 200 tables
// with 23 degrees of freedom know a mean square to √(2/4600) = 2.1 %: within four of these.
TEST(PowerLawFit, TheScatterOfOneAngleDoesNotHangOnTheNumberOfRepeats) {
  for (const int n : {2, 10}) {
    Noise noise(5);
    double squares = 0.0, misfits = 0.0;
    for (int repeat = 0; repeat < 200; ++repeat) {
      const PowerLaw law = fit_power_law(missed(noise, 1.0, 0.5, [n](int) { return n; }));
      squares += std::pow(law.error.standard_deviation, 2) / 200.0;
      misfits += std::pow(law.error.misfit, 2) / 200.0;
    }
    EXPECT_NEAR(squares, 1.25, 0.085 * 1.25) << n << " repeats";
    EXPECT_NEAR(misfits, 1.0, 0.1) << n << " repeats";
  }
}

// A point that was run ten times says as little of the law as one that was run twice. Tolerance as above; the
// degrees of freedom are a guess where points weigh unequally, so that the interval may hold a little less:
// 0.92.
TEST(PowerLawFit, IntervalsCoverWhereThePointsWereRepeatedUnequally) {
  Noise noise(99);
  std::array<int, 4> covered{};
  for (int repeat = 0; repeat < 500; ++repeat) {
    const PowerLaw law = fit_power_law(missed(noise, 1.0, 0.3, [](int k) { return k % 3 == 0 ? 10 : 2; }));
    const std::array<double, 4> truth = {test::kC, test::kA, test::kB, test::kExponentS};
    for (std::size_t k = 0; k < 4; ++k) {
      const Range& interval = law.parameters()[k]->interval_95;
      covered[k] += interval.low <= truth[k] && truth[k] <= interval.high ? 1 : 0;
    }
  }
  for (const int count : covered) {
    EXPECT_GE(count / 500.0, 0.92);
    EXPECT_LE(count / 500.0, 0.95 + 3.5 * 0.0097);
  }
}

TEST(PowerLawFit, ExactRepeatsLackNoFit) {
  std::vector<Observation> table = article_table();
  table.insert(table.end(), table.begin(), table.begin() + 27);
  const PowerLaw law = fit_power_law(table);
  EXPECT_EQ(law.error.lack_of_fit_p, 1.0);
  EXPECT_EQ(law.error.misfit, 0.0);
  EXPECT_TRUE(law.remarks.empty());
}

TEST(PowerLawFit, AZeroThatIsLeftAloneByAnotherOnesRowsDoesNoHarm) {
  const auto row = [](double e, double mu_s, double angle) {
    Observation one{e, mu_s, 0.1};
    one.angle = angle;
    return one;
  };
  const PowerLaw law =
      fit_power_law(std::vector<Observation>{row(0.0, 0.2, 25.0), row(0.0, 0.4, 29.0), row(0.0, 0.8, 35.0),
                                             row(0.3, 0.0, 15.0), row(0.3, 0.0, 16.0)});
  EXPECT_EQ(law.points, 3);
  EXPECT_FALSE(law.a.identified);
  EXPECT_TRUE(law.c.identified);
}

// Fewer tables, because each is refitted 200 times: 800 intervals, those of one table not independent, so
// that 95 % has a deviation of 1.1 % or so.
TEST(PowerLawFit, MinimaxIntervalsCoverToo) {
  Noise noise(31);
  int covered = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const PowerLaw law = fit_power_law(noisy(article_table(), noise, 1.0), Loss::minimax);
    const std::array<double, 4> truth = {test::kC, test::kA, test::kB, test::kExponentS};
    for (std::size_t k = 0; k < 4; ++k) {
      const Range& interval = law.parameters()[k]->interval_95;
      covered += interval.low <= truth[k] && truth[k] <= interval.high ? 1 : 0;
    }
  }
  EXPECT_NEAR(covered / 800.0, 0.95, 2.5 * 0.011);
}

TEST(PowerLawFit, LeavesRowsOutByNameWithTheReason) {
  std::vector<Observation> table = article_table();
  table[0].exclusion = "no heap: 3 bodies left on the base";
  table[1].mu_s = 0.0;
  table[2].e = 0.0;
  table[3].angle = 0.0;
  table[4].angle = std::numeric_limits<double>::quiet_NaN();
  table[5].mu_r = -0.1;
  table[6].mu_s = std::numeric_limits<double>::infinity();
  const PowerLaw law = fit_power_law(table);
  EXPECT_EQ(law.points, 20);
  EXPECT_NEAR(law.C.value, test::kC, 1e-10);
  std::vector<std::string> reasons;
  for (const Excluded& row : law.excluded) reasons.push_back(row.reason);
  const std::vector<std::string> expected = {"no heap: 3 bodies left on the base",
                                             "angle = 0 deg: must be > 0",
                                             "the angle is not a finite number",
                                             "mu_r = -0.1: must be > 0",
                                             "mu_s is not a finite number",
                                             "e_pp = 0: a power law cannot take a factor at 0",
                                             "mu_s = 0: a power law cannot take a factor at 0"};
  EXPECT_EQ(reasons, expected);
}

TEST(PowerLawFit, AFactorThatStandsStillHasNoExponent) {
  std::vector<Observation> table;
  for (const Observation& row : article_table()) {
    if (row.e == 0.3) table.push_back(row);
  }
  const PowerLaw law = fit_power_law(table);
  EXPECT_FALSE(law.a.identified);
  EXPECT_EQ(law.a.value, 0.0);
  EXPECT_TRUE(std::isnan(law.a.standard_error));
  EXPECT_TRUE(std::isnan(law.correlation()(0, 1)));
  EXPECT_NEAR(law.C.value, test::kC * std::pow(0.3, test::kA), 1e-10);
  EXPECT_NEAR(law.b.value, test::kB, 1e-12);
  ASSERT_EQ(law.remarks.size(), 1U);
  EXPECT_NE(law.remarks[0].find("e_pp is 0.3 in every point"), std::string::npos);
  EXPECT_NEAR(law.predict({0.9, 0.4, 0.1}), article_angle(0.3, 0.4, 0.1), 1e-10);
}

TEST(PowerLawFit, AFactorAtZeroThroughoutDoesNoHarm) {
  std::vector<Observation> table;
  for (Observation row : article_table()) {
    if (row.e == 0.3) {
      row.e = 0.0;
      table.push_back(row);
    }
  }
  const PowerLaw law = fit_power_law(table);
  EXPECT_EQ(law.points, 9);
  EXPECT_FALSE(law.a.identified);
  EXPECT_NEAR(law.c.value, test::kExponentS, 1e-12);
}

TEST(PowerLawFit, SaysWhyATableCannotBeFitted) {
  EXPECT_EQ(fit_message({}), "nothing to fit: the table has no rows");

  std::vector<Observation> table = article_table();
  for (Observation& row : table) row.exclusion = "timed_out";
  table[0].exclusion = "no_heap";
  EXPECT_EQ(fit_message(table),
            "nothing to fit: none of the 27 rows can be used:\n  1 x no_heap\n  26 x timed_out");

  table = article_table();
  table.resize(4);  // mu_s 0.2, mu_r 0.05, 0.1, 0.2; mu_s 0.4
  EXPECT_EQ(fit_message(table), "fitted");
  table.resize(3);
  EXPECT_EQ(fit_message(table), "fitted");
  table.resize(2);
  EXPECT_EQ(fit_message(table),
            "too few points: 2 distinct points cannot determine C and the exponents of mu_r, "
            "at least 3 are needed");

  table = std::vector<Observation>(5, article_table().front());
  EXPECT_EQ(fit_message(table),
            "too few points: 1 distinct point cannot determine C alone (no factor varies), "
            "at least 2 are needed");

  table = article_table();
  for (Observation& row : table) row.mu_r = 0.25 * row.mu_s;
  EXPECT_NE(fit_message(table).find("only vary together"), std::string::npos);
}

TEST(PowerLawFit, EqualAnglesHaveNoRSquared) {
  std::vector<Observation> table = article_table();
  for (Observation& row : table) row.angle = 30.0;
  const PowerLaw law = fit_power_law(table);
  EXPECT_TRUE(std::isnan(law.r_squared));
  EXPECT_NEAR(law.C.value, 30.0, 1e-10);
  EXPECT_NEAR(law.c.value, 0.0, 1e-13);
}

TEST(PowerLawFit, IsTheSameToTheBitWhenRepeated) {
  Noise noise(6);
  const std::vector<Observation> table = noisy(article_table(2), noise, 1.5);
  for (const Loss loss : {Loss::least_squares, Loss::minimax}) {
    const PowerLaw first = fit_power_law(table, loss);
    const PowerLaw second = fit_power_law(table, loss);
    EXPECT_EQ(first.C.value, second.C.value);
    EXPECT_EQ(first.covariance, second.covariance);
  }
}

// The standard error of a prediction against refits to new noise; 400 refits know a deviation to 3.5 %.
TEST(PowerLawFit, StandardErrorOfAPredictionAgreesWithRefits) {
  Noise noise(19);
  const Factors at{0.2, 0.7, 0.06};
  double sum = 0.0;
  double squares = 0.0;
  double stated = 0.0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    const PowerLaw law = fit_power_law(noisy(article_table(), noise, 1.0));
    sum += law.predict(at);
    squares += std::pow(law.predict(at), 2);
    stated += law.standard_error_at(at) / 400.0;
  }
  EXPECT_NEAR(std::sqrt(squares / 400.0 - std::pow(sum / 400.0, 2)), stated, 4 * 0.035 * stated);
}

TEST(Loss, IsNamed) {
  EXPECT_EQ(loss_named("minimax"), Loss::minimax);
  EXPECT_EQ(loss_named("least-squares"), Loss::least_squares);
  EXPECT_THROW(loss_named("huber"), Unusable);
}

}  // namespace
}  // namespace repose::fit
