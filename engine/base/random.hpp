#pragma once

#include <cstdint>

#include "engine/base/vec3.hpp"

namespace repose {

/// SplitMix64 finaliser: a bijection of 64-bit words with good avalanche (Steele, Lea & Flood 2014).
inline constexpr std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// A stream of random numbers that is the same on every machine and for every standard library
/// (the distributions of <random> are not). SplitMix64 over a counter; streams of one seed are independent.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : state_(mix64(seed) ^ mix64(stream + kGamma)) {}

  std::uint64_t next() { return mix64(state_ += kGamma); }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0 … n−1}, n > 0; the bias of the multiplication is below n / 2^53.
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
  }
  /// Standard normal (Box–Muller, one of the pair).
  double normal();
  /// Uniform over rotations (Shoemake 1992).
  Quat rotation();

 private:
  static constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15ULL;
  std::uint64_t state_;
};

}  // namespace repose
