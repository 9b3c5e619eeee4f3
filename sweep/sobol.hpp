#pragma once

#include <cstdint>
#include <vector>

namespace repose::sweep {

/// Most dimensions that SobolSequence knows.
inline constexpr int kSobolDimensions = 21;

/// Sobol' points in [0, 1)^d, in Gray-code order, from the origin on:
///   x_0 = 0,   x_{n+1} = x_n XOR v_c   with c the lowest zero bit of n,   v_k = m_k / 2^k,
///   m_k = 2 a_1 m_{k−1} XOR … XOR 2^{s−1} a_{s−1} m_{k−s+1} XOR 2^s m_{k−s} XOR m_{k−s}.
/// The origin is kept: without it the first 2^k points no longer hold one point in each of 2^k strata
/// (Owen 2022). A shift XORs every coordinate with its own random word, which keeps that property.
/// Source: Joe & Kuo, SIAM J. Sci. Comput. 30 (2008) 2635, direction numbers new-joe-kuo-6.21201;
/// order: Antonov & Saleev 1979.
class SobolSequence {
 public:
  /// @param dimensions  1 … kSobolDimensions
  /// @param shift       one word a dimension, or empty for none
  /// Throws std::invalid_argument for another number of dimensions.
  explicit SobolSequence(int dimensions, std::vector<std::uint32_t> shift = {});

  /// The next point; 2^32 points before the sequence repeats itself.
  std::vector<double> next();

 private:
  std::vector<std::vector<std::uint32_t>> directions_;  ///< v_k of each dimension, scaled by 2^32
  std::vector<std::uint32_t> state_;
  std::uint32_t index_ = 0;
};

}  // namespace repose::sweep
