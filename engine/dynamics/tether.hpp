#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/cell_grid.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// A body as one end of its tethers, half a cache line.
struct alignas(32) TetherEnd {
  double position[3] = {};  ///< [m]
  double used = 0.0;  ///< Bodies::swung, and how far the body may go before its tethers are looked over [m]

  TetherEnd() = default;
  TetherEnd(const Bodies& bodies, std::size_t i, double further)
      : position{bodies.x[i], bodies.y[i], bodies.z[i]}, used(bodies.swung[i] + further) {}
};

/// Bounds how far spheres of two bodies move towards each other. Since an earlier pose that is at most
///
///   |Δ apart| + Δ swung,   apart = x_i − x_j, swung of both together,
///
/// the way of the bodies and the paths that their spheres have swung about them. Two bodies that go the same
/// way get nowhere by it, however fast they are. Four floats, since there are many pairs: what they round off
/// counts as movement.
class alignas(16) Tether {
 public:
  /// Holds nothing.
  Tether() = default;
  /// @param slack  how far the two may move towards each other from here [m]
  Tether(const Bodies& bodies, const BodyPair& pair, double slack) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const Vec3 apart = bodies.position(i) - bodies.position(j);
    for (int k = 0; k < 3; ++k) record_[k] = static_cast<float>(apart[k]);
    record_[3] = static_cast<float>(bodies.swung[i] + bodies.swung[j] + slack);
  }
  /// Holds whatever happens.
  [[nodiscard]] static Tether endless() {
    Tether tether;
    tether.record_[3] = std::numeric_limits<float>::max();
    return tether;
  }

  /// apart [m], and the limit of swung where nothing else has moved [m].
  [[nodiscard]] const float* record() const { return record_; }

 private:
  float record_[4] = {0.0F, 0.0F, 0.0F, -std::numeric_limits<float>::infinity()};
};

/// Of kSimdWidth tethers from `first` on, bit l: whether that of pair first + l lets go, before its two
/// bodies have gone as far as their ends say. Lanes beyond the last tether repeat it.
[[nodiscard]] inline unsigned let_go(std::span<const Tether> tethers, std::span<const BodyPair> pairs,
                                     std::span<const TetherEnd> ends, std::size_t first) {
  constexpr int kRecord = 4;  // doubles
  alignas(64) double record[kSimdWidth][kRecord];
  LaneOffsets at, at_i, at_j;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    const std::size_t p = std::min(first + lane, tethers.size() - 1);
    for (int k = 0; k < kRecord; ++k) record[lane][k] = static_cast<double>(tethers[p].record()[k]);
    at[lane] = kRecord * static_cast<int>(lane);
    at_i[lane] = kRecord * pairs[p].i, at_j[lane] = kRecord * pairs[p].j;
  }
  const Fields4 then = load_fields4(record[0], at.data());
  const Fields4 i = load_fields4(ends.data()->position, at_i.data()),
                j = load_fields4(ends.data()->position, at_j.data());
  SimdReal moved = 0.0, rounded = absolute(then[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    const SimdReal apart = i[k] - j[k], by = apart - then[k];
    moved += by * by;
    rounded += absolute(apart);
  }
  const SimdReal left =
      then[3] - (i[3] + j[3]) - static_cast<double>(std::numeric_limits<float>::epsilon()) * rounded;
  return less_bits(left, SimdReal(0.0)) | less_bits(left * left, moved);
}

/// visit(p) for every tether that lets go, ascending; it may replace that tether.
template <class Visit>
void for_each_let_go(std::span<const Tether> tethers, std::span<const BodyPair> pairs,
                     std::span<const TetherEnd> ends, Visit visit) {
  for (std::size_t first = 0; first < tethers.size(); first += kSimdWidth) {
    unsigned bits = let_go(tethers, pairs, ends, first);
    if (tethers.size() - first < kSimdWidth) bits &= (1U << (tethers.size() - first)) - 1;
    for (; bits != 0; bits &= bits - 1) visit(first + static_cast<std::size_t>(std::countr_zero(bits)));
  }
}

}  // namespace repose
