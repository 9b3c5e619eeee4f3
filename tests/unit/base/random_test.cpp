#include "engine/base/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace repose {
namespace {

// Statistical tests run on fixed seeds, so each passes always or never; tolerances are five standard errors
// of the statistic, which a sound generator exceeds for one seed in two million.
constexpr int kDraws = 200000;
constexpr double kSigmas = 5.0;

double standard_error(double variance) { return std::sqrt(variance / kDraws); }

// The first outputs of SplitMix64 for the seed 1234567, as published with its reference implementation.
TEST(Mix64, IsTheFinaliserOfSplitMix64) {
  const std::array<std::uint64_t, 5> published = {6457827717110365317ULL, 3203168211198807973ULL,
                                                  9817491932198370423ULL, 4593380528125082431ULL,
                                                  16408922859458223821ULL};
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : published) EXPECT_EQ(mix64(state += 0x9e3779b97f4a7c15ULL), expected);
}

// Computed apart from the engine with integers of any length.
TEST(RandomStream, GivesTheSameNumbersOnEveryMachine) {
  RandomStream first(1, 0);
  EXPECT_EQ(first.next(), 0x346dbc0b5711d830ULL);
  EXPECT_EQ(first.next(), 0x6b182a52253dda4aULL);
  EXPECT_EQ(first.next(), 0x6e2758640b1bd75bULL);
  EXPECT_EQ(first.next(), 0x7a4d456004a96fc9ULL);
  RandomStream second(1, 1);
  EXPECT_EQ(second.next(), 0x017daf0019666393ULL);
  EXPECT_EQ(second.next(), 0xd9e484272f675712ULL);
  RandomStream last(~0ULL, 7);
  EXPECT_EQ(last.next(), 0x8c5b9b19478931f8ULL);
  EXPECT_EQ(last.next(), 0x31172a888e606b5bULL);
}

TEST(RandomStream, IsUniformOnTheHalfOpenUnitInterval) {
  RandomStream random(1, 2);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  // E u = 1/2, Var u = 1/12; E u² = 1/3, Var u² = 1/5 − 1/9
  EXPECT_NEAR(sum / kDraws, 0.5, kSigmas * standard_error(1.0 / 12.0));
  EXPECT_NEAR(squares / kDraws, 1.0 / 3.0, kSigmas * standard_error(1.0 / 5.0 - 1.0 / 9.0));
}

TEST(RandomStream, StretchesTheIntervalThatIsAskedFor) {
  RandomStream unit(3, 0);
  RandomStream wide(3, 0);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(wide.uniform(-2.0, 6.0), -2.0 + 8.0 * unit.uniform());
}

// Pearson's χ² of 16 cells: mean 15, variance 30.
TEST(RandomStream, FillsTheCellsOfBelowEvenly) {
  RandomStream random(4, 0);
  std::array<double, 16> cells{};
  for (int i = 0; i < kDraws; ++i) {
    const std::uint64_t cell = random.below(16);
    ASSERT_LT(cell, 16U);
    cells.at(cell) += 1.0;
  }
  const double expected = kDraws / 16.0;
  double chi_squared = 0.0;
  for (const double count : cells) chi_squared += (count - expected) * (count - expected) / expected;
  EXPECT_NEAR(chi_squared, 15.0, kSigmas * std::sqrt(30.0));
}

TEST(RandomStream, DrawsNormalNumbers) {
  RandomStream random(5, 0);
  std::array<double, 4> moments{};
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    double power = 1.0;
    for (double& moment : moments) moment += (power *= x) / kDraws;
  }
  // E x^k = 0, 1, 0, 3; Var x^k = E x^{2k} − (E x^k)² = 1, 2, 15, 96
  const std::array<double, 4> means = {0.0, 1.0, 0.0, 3.0};
  const std::array<double, 4> variances = {1.0, 2.0, 15.0, 96.0};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(moments.at(k), means.at(k), kSigmas * standard_error(variances.at(k))) << k + 1;
}

// A rotation matrix drawn evenly has entries of mean 0, mean square 1/3 and mean fourth power 1/5 (each
// column is an even direction), so the variance of the squares is 1/5 − 1/9.
TEST(RandomStream, DrawsRotationsEvenly) {
  RandomStream random(6, 0);
  Mat3 mean = Mat3::Zero();
  Mat3 mean_square = Mat3::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Quat q = random.rotation();
    ASSERT_NEAR(q.norm(), 1.0, 1e-15);  // rounding
    const Mat3 rotation = q.toRotationMatrix();
    mean += rotation / kDraws;
    mean_square += rotation.cwiseProduct(rotation) / kDraws;
  }
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), kSigmas * standard_error(1.0 / 3.0));
  EXPECT_LT((mean_square.array() - 1.0 / 3.0).abs().maxCoeff(),
            kSigmas * standard_error(1.0 / 5.0 - 1.0 / 9.0));
}

/// Correlation of two streams; its standard error is 1/√n.
double correlation(RandomStream a, RandomStream b) {
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  return 12.0 * sum / kDraws;
}

TEST(RandomStream, HasIndependentStreamsForNeighbouringSeedsAndStreams) {
  for (std::uint64_t k = 0; k < 8; ++k) {
    EXPECT_LT(std::abs(correlation({k, 0}, {k + 1, 0})), kSigmas * standard_error(1.0)) << k;
    EXPECT_LT(std::abs(correlation({1, k}, {1, k + 1})), kSigmas * standard_error(1.0)) << k;
    EXPECT_LT(std::abs(correlation({k, k + 1}, {k + 1, k})), kSigmas * standard_error(1.0)) << k;
  }
}

TEST(RandomStream, DoesNotFollowItself) {
  RandomStream ahead(1, 0);
  ahead.next();
  EXPECT_LT(std::abs(correlation({1, 0}, ahead)), kSigmas * standard_error(1.0));
}

}  // namespace
}  // namespace repose
