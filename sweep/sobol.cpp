#include "sweep/sobol.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <stdexcept>

namespace repose::sweep {

namespace {

constexpr int kBits = 32;

/// A line of Joe and Kuo's table: degree s, coefficients a_1 … a_{s−1} as bits, m_1 … m_s.
struct Direction {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 7> m;
};

/// Dimensions 2 … 21; the first dimension is van der Corput's sequence.
constexpr std::array<Direction, kSobolDimensions - 1> kTable = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};

std::vector<std::uint32_t> van_der_corput() {
  std::vector<std::uint32_t> v(kBits);
  for (int k = 0; k < kBits; ++k) v[static_cast<std::size_t>(k)] = 1U << (kBits - 1 - k);
  return v;
}

std::vector<std::uint32_t> directions_of(const Direction& line) {
  const auto s = static_cast<std::size_t>(line.degree);
  std::vector<std::uint32_t> v(kBits);
  for (std::size_t k = 0; k < s; ++k) v[k] = line.m[k] << (kBits - 1 - k);
  for (std::size_t k = s; k < kBits; ++k) {
    v[k] = v[k - s] ^ (v[k - s] >> s);
    for (std::size_t i = 1; i < s; ++i)
      if ((line.coefficients >> (s - 1 - i)) & 1U) v[k] ^= v[k - i];
  }
  return v;
}

}  // namespace

SobolSequence::SobolSequence(int dimensions, std::vector<std::uint32_t> shift) : state_(std::move(shift)) {
  if (dimensions < 1 || dimensions > kSobolDimensions)
    throw std::invalid_argument("Sobol' points of so many dimensions are not known here");
  state_.resize(static_cast<std::size_t>(dimensions));
  directions_.push_back(van_der_corput());
  for (std::size_t d = 1; d < state_.size(); ++d) directions_.push_back(directions_of(kTable[d - 1]));
}

std::vector<double> SobolSequence::next() {
  std::vector<double> point;
  point.reserve(state_.size());
  for (const std::uint32_t x : state_) point.push_back(x * 0x1.0p-32);
  const auto change = static_cast<std::size_t>(std::countr_one(index_++)) % kBits;
  for (std::size_t d = 0; d < state_.size(); ++d) state_[d] ^= directions_[d][change];
  return point;
}

}  // namespace repose::sweep
