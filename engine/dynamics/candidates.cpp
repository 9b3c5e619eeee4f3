#include "engine/dynamics/candidates.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/dynamics/simd_records.hpp"

namespace repose {

void CandidateArrays::put_last_into(CandidateSlot& slot, std::size_t begin) {
  CandidateSlot added = slot_from(begin);
  added.changed |= slot.changed || slot.near != 0;
  if (added.count > slot.room) {
    slot = added;
    return;
  }
  slot.count = added.count, slot.near = added.near, slot.changed = added.changed;
  for (auto* array : {&a, &b}) {
    std::copy(array->begin() + added.begin, array->end(), array->begin() + slot.begin);
    array->resize(begin);
  }
  std::copy(near.begin() + added.begin, near.end(), near.begin() + slot.begin);
  near.resize(begin);
}

void CandidateArrays::close_up(std::span<CandidateSlot> slots) {
  CandidateArrays closed;
  for (CandidateSlot& slot : slots) {
    const std::size_t begin = closed.count();
    const auto copy = [&](const auto& from, auto& to) {
      to.insert(to.end(), from.begin() + slot.begin, from.begin() + slot.begin + slot.count);
    };
    copy(a, closed.a), copy(b, closed.b), copy(near, closed.near);
    slot.begin = static_cast<std::uint32_t>(begin), slot.room = slot.count;
  }
  *this = std::move(closed);
}

bool CandidateArrays::is_loose(std::span<const CandidateSlot> slots) const {
  std::size_t used = 0;
  for (const CandidateSlot& slot : slots) used += slot.room;
  return count() > 2 * used;
}

void NearList::make_room(std::size_t entries) {
  if (spring.size() >= entries) return;
  const std::size_t room = entries + entries / 2;
  for (auto* array : {&sphere_a, &sphere_b, &placed_a, &placed_b, &body_a, &body_b}) array->resize(room);
  spring.resize(room);
  if (rolls) rolling.resize(room);
}

void NearList::set(std::size_t k, std::int32_t a, std::int32_t b, const BodyPair& bodies) {
  sphere_a[k] = a, body_a[k] = kLine * bodies.i;
  sphere_b[k] = b, body_b[k] = of_walls ? 0 : kLine * bodies.j;
}

void NearList::append(std::int32_t a, std::int32_t b, const BodyPair& bodies, const NearList& from,
                      std::size_t k) {
  make_room(count + 2 * kBlock);
  if (count % kBlock == 0) touching.push_back(0);
  touching.back() = static_cast<std::uint8_t>(touching.back() | (1U << (count % kBlock)));
  set(count, a, b, bodies);
  copy_history(from, k, count++);
}

/// Rows of a list that are to be kept as they are, neighbours together, found pair of bodies by pair of
/// bodies, ascending.
class NearList::OldRows {
 public:
  OldRows(const NearList& old, NearList& to) : old_(old), to_(to) {}

  /// `rows` rows of a pair of bodies stay.
  void keep(const BodyPair& bodies, std::size_t rows) {
    if (last_ == old_.count || of_bodies(last_) != key(bodies)) flush(), skip_to(key(bodies));
    last_ += rows;
  }
  /// Those of a pair of bodies that has changed: first … last − 1.
  std::pair<std::size_t, std::size_t> of(const BodyPair& bodies) {
    flush();
    skip_to(key(bodies));
    while (last_ < old_.count && of_bodies(last_) == key(bodies)) ++last_;
    return {std::exchange(first_, last_), last_};
  }
  void flush() {
    to_.keep(old_, first_, last_);
    first_ = last_;
  }

 private:
  [[nodiscard]] static std::int64_t together(std::int32_t high, std::int32_t low) {
    return (static_cast<std::int64_t>(high) << 32) | low;
  }
  [[nodiscard]] std::int64_t key(const BodyPair& bodies) const {
    return together(kLine * bodies.i, old_.of_walls ? 0 : kLine * bodies.j);
  }
  [[nodiscard]] std::int64_t of_bodies(std::size_t row) const {
    return together(old_.body_a[row], old_.body_b[row]);
  }
  /// Over rows of pairs of bodies that are no more.
  void skip_to(std::int64_t pair) {
    while (last_ < old_.count && of_bodies(last_) < pair) ++last_;
    first_ = last_;
  }

  const NearList& old_;
  NearList& to_;
  std::size_t first_ = 0, last_ = 0;  ///< rows that are to be kept next
};

void NearList::gather(const CandidateArrays& candidates, std::span<CandidateSlot> slots,
                      std::span<const BodyPair> bodies, const NearList& old) {
  clear();
  std::size_t all = 0;
  for (const CandidateSlot& slot : slots) all += slot.near;
  make_room(all + 2 * kBlock);
  touching.assign(all / kBlock + 2, 0);
  OldRows rows(old, *this);
  for (std::size_t group = 0; group < slots.size(); ++group) {
    CandidateSlot& slot = slots[group];
    if (!slot.changed) {
      if (slot.near != 0) rows.keep(bodies[group], slot.near);
      continue;
    }
    slot.changed = false;
    const auto [first, last] = rows.of(bodies[group]);
    const std::size_t since = count;
    if (slot.near != 0) take(candidates, slot, bodies[group]);
    remember(old, first, last, since);
  }
  rows.flush();
  touching.resize((count + kBlock - 1) / kBlock);
  for (std::size_t k = count; k < blocks() * kBlock; ++k) set(k, 0, 0, {});
}

/// `bits` of the block of candidates that begins at `at`.
void NearList::set_touching(std::size_t at, unsigned bits) {
  const unsigned shifted = bits << (at % kBlock);
  touching[at / kBlock] = static_cast<std::uint8_t>(touching[at / kBlock] | shifted);
  touching[at / kBlock + 1] = static_cast<std::uint8_t>(touching[at / kBlock + 1] | shifted >> kBlock);
}

/// Rows first … last − 1 of another list, whole blocks at a time: what is copied beyond is written over.
void NearList::keep(const NearList& old, std::size_t first, std::size_t last) {
  const auto copy = [&](const auto& from, auto& to, std::size_t row) {
    std::copy_n(from.data() + row, kBlock, to.data() + count);
  };
  for (std::size_t row = first; row < last; row += kBlock) {
    const std::size_t n = std::min(kBlock, last - row), block = row / kBlock, shift = row % kBlock;
    unsigned bits = static_cast<unsigned>(old.touching[block]) >> shift;
    if (block + 1 < old.blocks()) bits |= static_cast<unsigned>(old.touching[block + 1]) << (kBlock - shift);
    set_touching(count, bits & ((1U << n) - 1));
    copy(old.sphere_a, sphere_a, row), copy(old.sphere_b, sphere_b, row);
    copy(old.body_a, body_a, row), copy(old.body_b, body_b, row);
    copy(old.spring, spring, row);
    if (rolls) copy(old.rolling, rolling, row);
    count += n;
  }
}

/// Eight candidates at a time, except at the end of the arrays.
void NearList::take(const CandidateArrays& candidates, const CandidateSlot& slot, const BodyPair& bodies) {
  const std::size_t begin = slot.begin, end = begin + slot.count;
  const std::int32_t line_a = kLine * bodies.i, line_b = of_walls ? 0 : kLine * bodies.j;
  const std::size_t whole = std::min(end, candidates.count() - std::min(candidates.count(), kBlock - 1));
  std::size_t first = begin;
  for (; first < whole; first += kBlock) {
    std::uint64_t flags;
    std::memcpy(&flags, candidates.near.data() + first, kBlock);
    unsigned bits = bits_of(flags);
    if (end - first < kBlock) bits &= (1U << (end - first)) - 1;
    if (bits == 0) continue;
    const KeptLanes kept(bits);
    kept.copy(candidates.a.data() + first, sphere_a.data() + count);
    kept.copy(candidates.b.data() + first, sphere_b.data() + count);
    std::fill_n(body_a.data() + count, kBlock, line_a);
    std::fill_n(body_b.data() + count, kBlock, line_b);
    count += static_cast<std::size_t>(std::popcount(bits));
  }
  for (; first < end; ++first)
    if (candidates.near[first] != 0) set(count++, candidates.a[first], candidates.b[first], bodies);
}

void NearList::find_places(std::span<const std::int32_t> place_of) {
  const auto offset = [&](std::int32_t sphere) {
    return kRecord * place_of[static_cast<std::size_t>(sphere)];
  };
  for (std::size_t k = 0; k < blocks() * kBlock; ++k) {
    placed_a[k] = offset(sphere_a[k]);
    placed_b[k] = of_walls ? sphere_b[k] : offset(sphere_b[k]);
  }
}

/// Of rows first … last − 1 of another list, what those of the same spheres among the rows from `since` on
/// remember. Both ascend: one pass over them.
void NearList::remember(const NearList& old, std::size_t first, std::size_t last, std::size_t since) {
  const auto spheres = [](const NearList& list, std::size_t at) {
    return std::pair(list.sphere_a[at], list.sphere_b[at]);
  };
  std::size_t k = since;
  for (std::size_t was = first; was < last; ++was) {
    if (!old.touches(was)) continue;
    while (k < count && spheres(*this, k) < spheres(old, was)) ++k;
    if (k == count || spheres(*this, k) != spheres(old, was)) continue;
    copy_history(old, was, k);
    set_touching(k, 1);
  }
}

}  // namespace repose
