#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "engine/dynamics/cell_grid.hpp"

namespace repose {

/// A sphere of a body in the world; half a cache line.
struct alignas(32) PlacedSphere {
  double centre[3] = {};  ///< [m]
  double radius = 0.0;    ///< [m]
};

/// What a contact remembers (contact/hertz_mindlin.hpp, contact/rolling.hpp).
struct alignas(32) SpringRecord {
  double value[3] = {};
  double root = 0.0;
};
struct alignas(32) RollingRecord {
  double torque[3] = {};
  double unused = 0.0;
};

/// Where the candidates of a pair of bodies, or of a body with walls, lie in CandidateArrays.
struct CandidateSlot {
  std::uint32_t begin = 0, count = 0, room = 0;
  std::uint32_t near = 0;  ///< how many of them are
  bool changed = false;    ///< others are near than when the near list was gathered
};

/// Eight flags, a byte each, 0 or 1, the first in the lowest byte, from eight bits and back. To spread bits,
/// byte k keeps bit k of a copy of all, and the sum carries it to the byte's top. To collect them, flag k is
/// multiplied to bit 56 + k; no two products of a flag and a bit of the factor meet.
static_assert(std::endian::native == std::endian::little);
inline std::uint64_t flags_of(unsigned bits) {
  const std::uint64_t spread = (0x0101010101010101U * std::uint64_t{bits & 0xffU}) & 0x8040201008040201U;
  return ((spread + 0x7f7f7f7f7f7f7f7fU) >> 7) & 0x0101010101010101U;
}
inline unsigned bits_of(std::uint64_t flags) {
  return static_cast<unsigned>((flags * 0x0102040810204080U) >> 56);
}

/// Candidates for contact as flat arrays. There are many times more of them than contacts, so they hold
/// nothing else: what contacts remember is in the NearList. Those of one slot lie side by side, slots
/// anywhere.
struct CandidateArrays {
  std::vector<std::int32_t> a;     ///< sphere of body i
  std::vector<std::int32_t> b;     ///< sphere of body j; for a wall candidate the wall
  std::vector<std::uint8_t> near;  ///< 1: may touch before its bodies are looked at again

  [[nodiscard]] std::size_t count() const { return a.size(); }
  void clear() { a.clear(), b.clear(), near.clear(); }
  /// Those from `begin` on, of which no near list knows yet.
  [[nodiscard]] CandidateSlot slot_from(std::size_t begin) const {
    const auto n = static_cast<std::uint32_t>(count() - begin);
    const auto is_near = std::ranges::count_if(near.begin() + static_cast<std::ptrdiff_t>(begin), near.end(),
                                               [](std::uint8_t flag) { return flag != 0; });
    return {static_cast<std::uint32_t>(begin), n, n, static_cast<std::uint32_t>(is_near), is_near != 0};
  }
  /// Adds a candidate; near = 0: nobody has looked at it yet.
  void push(std::int32_t first, std::int32_t second, std::uint8_t is_near = 0) {
    a.push_back(first), b.push_back(second), near.push_back(is_near);
  }
  /// The candidates from `begin` on, added last, become those of a slot: in its room if they fit in there.
  void put_last_into(CandidateSlot& slot, std::size_t begin);
  /// Brings the candidates into the order of their slots, and leaves out what belongs to none.
  void close_up(std::span<CandidateSlot> slots);
  /// Whether most of the arrays belongs to none of the slots.
  [[nodiscard]] bool is_loose(std::span<const CandidateSlot> slots) const;
  /// `near` of the candidates first … first + n − 1 of a slot, n ≤ 8, from the lowest bits; those that are
  /// add to the slot's, and if one is other than it was the slot has changed.
  void set_near(CandidateSlot& slot, std::size_t first, std::size_t n, unsigned bits) {
    if (n < 8) bits &= (1U << n) - 1;
    const std::uint64_t flags = flags_of(bits);
    std::uint64_t were = 0;
    if (n == 8) {  // a copy of fixed size is one instruction
      std::memcpy(&were, near.data() + first, 8);
      std::memcpy(near.data() + first, &flags, 8);
    } else {
      std::memcpy(&were, near.data() + first, n);
      std::memcpy(near.data() + first, &flags, n);
    }
    slot.near += static_cast<std::uint32_t>(std::popcount(bits));
    slot.changed |= were != flags;
  }
};

/// The candidates that may touch before their bodies are looked at again, ascending by bodies and spheres,
/// ready for the kernels and with what they remember. Padded to whole blocks of kBlock with pairs that never
/// touch.
struct NearList {
  static constexpr std::size_t kBlock = 8;
  static constexpr std::int32_t kLine = 8;    ///< doubles of a body's record
  static constexpr std::int32_t kRecord = 4;  ///< doubles of a PlacedSphere, SpringRecord or RollingRecord

  /// @param of_walls  the second side is a wall
  /// @param rolls     contacts remember a rolling spring
  NearList(bool of_walls, bool rolls) : of_walls(of_walls), rolls(rolls) {}

  std::vector<std::int32_t> sphere_a,
      sphere_b;  ///< among those of all bodies; at a wall b is the wall's number
  // Offsets of records, in doubles.
  std::vector<std::int32_t> placed_a, placed_b;  ///< of PlacedSphere; at a wall b is the wall's number
  std::vector<std::int32_t> body_a, body_b;      ///< of the bodies' records
  std::vector<std::uint8_t> touching;            ///< one bit per candidate of a block, at the last step
  // What contacts remember; of those that touch.
  std::vector<SpringRecord> spring;
  std::vector<RollingRecord> rolling;  ///< empty unless `rolls`
  std::size_t count = 0;               ///< without padding
  bool of_walls = false, rolls = false;

  [[nodiscard]] std::size_t blocks() const { return touching.size(); }
  [[nodiscard]] const PlacedSphere& first(std::span<const PlacedSphere> placed, std::size_t k) const {
    return placed[static_cast<std::size_t>(placed_a[k] / kRecord)];
  }
  [[nodiscard]] const PlacedSphere& second(std::span<const PlacedSphere> placed, std::size_t k) const {
    return placed[static_cast<std::size_t>(placed_b[k] / kRecord)];
  }
  [[nodiscard]] std::size_t wall(std::size_t k) const { return static_cast<std::size_t>(placed_b[k]); }
  [[nodiscard]] std::size_t first_body(std::size_t k) const {
    return static_cast<std::size_t>(body_a[k] / kLine);
  }
  [[nodiscard]] std::size_t second_body(std::size_t k) const {
    return static_cast<std::size_t>(body_b[k] / kLine);
  }
  /// Candidate k begins to touch, and remembers nothing.
  void begin(std::size_t k) {
    spring[k] = {};
    if (rolls) rolling[k] = {};
  }
  /// visit(*this, k) for every candidate that touched at the last step, ascending.
  template <class Visit>
  void for_each_touched(Visit visit) const {
    for (std::size_t block = 0; block < blocks(); ++block)
      for (unsigned bits = touching[block]; bits != 0; bits &= bits - 1)
        visit(*this, block * kBlock + static_cast<std::size_t>(std::countr_zero(bits)));
  }
  void clear() { touching.clear(), count = 0; }
  /// Adds a candidate that touches and remembers what candidate k of another list does.
  void append(std::int32_t a, std::int32_t b, const BodyPair& bodies, const NearList& from, std::size_t k);
  /// Takes the candidates whose `near` is set. Of those that touched, the ones that are near keep what `old`,
  /// this list as it was before, remembers of them. Rows of slots that have not changed are taken from `old`
  /// as they are. The padding is the dummy sphere against itself.
  /// @param slots, bodies  candidates of slots[g] are of bodies[g]; at walls j counts for nothing. Slots that
  ///                       have changed have not any more.
  void gather(const CandidateArrays& candidates, std::span<CandidateSlot> slots,
              std::span<const BodyPair> bodies, const NearList& old);
  /// Sets placed_a and placed_b.
  /// @param place_of  index of each sphere's PlacedSphere
  void find_places(std::span<const std::int32_t> place_of);
  /// Candidate k is one of another wall.
  void set_wall(std::size_t k, int wall) { sphere_b[k] = placed_b[k] = wall; }

 private:
  class OldRows;
  void make_room(std::size_t entries);
  void take(const CandidateArrays& candidates, const CandidateSlot& slot, const BodyPair& bodies);
  void set(std::size_t k, std::int32_t a, std::int32_t b, const BodyPair& bodies);
  [[nodiscard]] bool touches(std::size_t k) const { return (touching[k / kBlock] >> (k % kBlock) & 1U) != 0; }
  void set_touching(std::size_t at, unsigned bits);
  void keep(const NearList& old, std::size_t first, std::size_t last);
  void remember(const NearList& old, std::size_t first, std::size_t last, std::size_t since);
  void copy_history(const NearList& from, std::size_t at, std::size_t to) {
    spring[to] = from.spring[at];
    if (rolls) rolling[to] = from.rolling[at];
  }
};

/// visit(k) for every flag k, begin ≤ k < end, that is not 0, ascending; most are 0.
template <class Visit>
void for_each_flag(std::span<const std::uint8_t> flags, std::size_t begin, std::size_t end, Visit visit) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t);
  for (std::size_t first = begin; first < end; first += kAtOnce) {
    std::uint64_t some = 0;  // a byte a flag, each 0 or 1
    const std::size_t left = end - first;
    if (first + kAtOnce <= flags.size()) {  // a copy of fixed size is one instruction
      std::memcpy(&some, flags.data() + first, kAtOnce);
      if (left < kAtOnce) some &= (std::uint64_t{1} << (8 * left)) - 1;
    } else {
      std::memcpy(&some, flags.data() + first, std::min(kAtOnce, left));
    }
    for (; some != 0; some &= some - 1) visit(first + static_cast<std::size_t>(std::countr_zero(some)) / 8);
  }
}

}  // namespace repose
