#include "engine/dynamics/candidates.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/dynamics/simd_records.hpp"

namespace repose {

void CandidateArrays::put_last_into(CandidateSlot& slot, std::size_t begin) {
  const CandidateSlot added = slot_from(begin);
  if (added.count > slot.room) {
    slot = added;
    return;
  }
  slot.count = added.count, slot.near = added.near;
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
    slot = closed.slot_from(begin);
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

void NearList::gather(const CandidateArrays& candidates, std::span<const CandidateSlot> slots,
                      std::span<const BodyPair> bodies, const NearList& old) {
  clear();
  for (std::size_t group = 0; group < slots.size(); ++group) {
    const CandidateSlot& slot = slots[group];
    if (slot.near == 0) continue;
    make_room(count + slot.near + 2 * kBlock);
    take(candidates, slot, bodies[group]);
  }
  make_room(count + kBlock);
  touching.assign((count + kBlock - 1) / kBlock, 0);
  for (std::size_t k = count; k < blocks() * kBlock; ++k) set(k, 0, 0, {});
  remember(old);
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

/// Both lists ascend: one pass over them.
void NearList::remember(const NearList& old) {
  const auto together = [](std::int32_t high, std::int32_t low) {
    return (static_cast<std::int64_t>(high) << 32) | low;
  };
  const auto of_bodies_at = [&](const NearList& list, std::size_t at) {
    return together(list.body_a[at], list.body_b[at]);
  };
  const auto spheres = [&](const NearList& list, std::size_t at) {
    return together(list.sphere_a[at], list.sphere_b[at]);
  };
  std::size_t k = 0;
  old.for_each_touched([&](const NearList&, std::size_t was) {
    const std::int64_t of_bodies = of_bodies_at(old, was), of_spheres = spheres(old, was);
    while (k < count && (of_bodies_at(*this, k) < of_bodies ||
                         (of_bodies_at(*this, k) == of_bodies && spheres(*this, k) < of_spheres)))
      ++k;
    if (k == count || spheres(*this, k) != of_spheres) return;
    copy_history(old, was, k);
    touching[k / kBlock] = static_cast<std::uint8_t>(touching[k / kBlock] | (1U << (k % kBlock)));
  });
}

}  // namespace repose
