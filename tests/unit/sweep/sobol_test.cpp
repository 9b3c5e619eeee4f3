#include "sweep/sobol.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

namespace repose::sweep {
namespace {

/// The first ten points in three dimensions as Joe and Kuo print them with their direction numbers; exact,
/// since all are multiples of 1/16.
TEST(SobolSequence, BeginsWithThePublishedPoints) {
  const std::vector<std::vector<double>> published = {{0, 0, 0},
                                                      {0.5, 0.5, 0.5},
                                                      {0.75, 0.25, 0.25},
                                                      {0.25, 0.75, 0.75},
                                                      {0.375, 0.375, 0.625},
                                                      {0.875, 0.875, 0.125},
                                                      {0.625, 0.125, 0.875},
                                                      {0.125, 0.625, 0.375},
                                                      {0.1875, 0.3125, 0.9375},
                                                      {0.6875, 0.8125, 0.4375}};
  SobolSequence sequence(3);
  for (const auto& point : published) EXPECT_EQ(sequence.next(), point);
}

/// Each dimension of the first 2^k points holds one point in each of 2^k strata (Sobol' 1967).
void expect_one_point_in_each_stratum(SobolSequence sequence, std::size_t dimensions) {
  constexpr int kPoints = 128;
  std::vector<std::set<int>> strata(dimensions);
  for (int i = 0; i < kPoints; ++i) {
    const auto point = sequence.next();
    for (std::size_t d = 0; d < dimensions; ++d) strata[d].insert(static_cast<int>(point[d] * kPoints));
  }
  for (const auto& of_dimension : strata) EXPECT_EQ(of_dimension.size(), std::size_t{kPoints});
}

TEST(SobolSequence, FillsEveryStratumOfEveryDimension) {
  expect_one_point_in_each_stratum(SobolSequence(kSobolDimensions), kSobolDimensions);
}

TEST(SobolSequence, FillsEveryStratumWhenShifted) {
  expect_one_point_in_each_stratum(SobolSequence(3, {0x12345678U, 0x9abcdef0U, 0xdeadbeefU}), 3);
}

/// Sobol's property A, which Joe and Kuo's table has: the first bits of the first d direction numbers of d
/// dimensions form a matrix that is regular modulo 2, so that 2^d points visit every half of every dimension
/// in every combination. A wrong digit in the table breaks it for the dimensions from there on. The direction
/// numbers are read off the sequence: point 2^k XOR point 2^k − 1 is direction k + 1.
TEST(SobolSequence, HasPropertyAInEveryNumberOfDimensions) {
  std::vector<std::uint32_t> rows(kSobolDimensions, 0);  // bit k: first bit of direction k of the dimension
  SobolSequence sequence(kSobolDimensions);
  auto last = sequence.next();
  for (std::uint32_t n = 1; n <= (1U << (kSobolDimensions - 1)); ++n) {
    const auto point = sequence.next();
    if (std::has_single_bit(n)) {
      for (std::size_t d = 0; d < rows.size(); ++d)
        if ((point[d] >= 0.5) != (last[d] >= 0.5)) rows[d] |= 1U << std::countr_zero(n);
    }
    last = point;
  }
  for (std::size_t dimensions = 1; dimensions <= rows.size(); ++dimensions) {
    std::vector<std::uint32_t> matrix(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(dimensions));
    std::size_t rank = 0;
    for (std::size_t column = 0; column < dimensions; ++column) {
      std::size_t pivot = rank;
      while (pivot < dimensions && !((matrix[pivot] >> column) & 1U)) ++pivot;
      if (pivot == dimensions) continue;
      std::swap(matrix[rank], matrix[pivot]);
      for (std::size_t row = 0; row < dimensions; ++row)
        if (row != rank && ((matrix[row] >> column) & 1U)) matrix[row] ^= matrix[rank];
      ++rank;
    }
    EXPECT_EQ(rank, dimensions);
  }
}

TEST(SobolSequence, RefusesMoreDimensionsThanItsTableHas) {
  EXPECT_THROW(SobolSequence(kSobolDimensions + 1), std::invalid_argument);
  EXPECT_THROW(SobolSequence(0), std::invalid_argument);
}

}  // namespace
}  // namespace repose::sweep
