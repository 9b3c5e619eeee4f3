#include "engine/dynamics/candidates.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace repose {

void CandidateArrays::append(const CandidateArrays& from, std::size_t begin, std::size_t end) {
  const auto copy = [&](const auto& source, auto& to) {
    to.insert(to.end(), source.data() + begin, source.data() + end);
  };
  copy(from.a, a), copy(from.b, b), copy(from.near, near);
}

void NearList::make_room(std::size_t entries) {
  if (history.size() >= entries) return;
  const std::size_t old = history.size(), room = entries + entries / 2;
  for (auto* array : {&history, &sphere_a, &sphere_b, &body_a, &body_b}) array->resize(room);
  spring.resize(room);
  if (rolls) rolling.resize(room);
  for (std::size_t k = old; k < room; ++k) history[k] = kRecord * static_cast<std::int32_t>(k);
}

void NearList::set(std::size_t k, std::int32_t a, std::int32_t b, std::span<const PlacedSphere> placed) {
  const auto body_of = [&](std::int32_t sphere) {
    return kLine * placed[static_cast<std::size_t>(sphere)].body;
  };
  sphere_a[k] = kLine * a, body_a[k] = body_of(a);
  sphere_b[k] = of_walls ? b : kLine * b, body_b[k] = of_walls ? 0 : body_of(b);
}

void NearList::gather(const CandidateArrays& candidates, std::span<const PlacedSphere> placed,
                      const NearList& old) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t);
  touching.clear();
  count = 0;
  const std::size_t n = candidates.count();
  for (std::size_t c = 0; c < n; c += kAtOnce) {
    std::uint64_t flags = 0;  // a byte a candidate
    std::memcpy(&flags, candidates.near.data() + c, std::min(kAtOnce, n - c));
    if (flags == 0) continue;
    make_room(count + 2 * kBlock);
    for (; flags != 0; flags &= flags - 1) {
      const std::size_t at = c + static_cast<std::size_t>(std::countr_zero(flags)) / 8;
      set(count, candidates.a[at], candidates.b[at], placed);
      forget(count++);
    }
  }
  make_room(count + kBlock);
  touching.assign((count + kBlock - 1) / kBlock, 0);
  for (std::size_t k = count; k < blocks() * kBlock; ++k) {
    set(k, 0, 0, placed);
    forget(k);
  }

  const auto together = [](std::int32_t high, std::int32_t low) {
    return (static_cast<std::int64_t>(high) << 32) | low;
  };
  const auto bodies = [&](const NearList& list, std::size_t at) {
    return together(list.body_a[at], list.body_b[at]);
  };
  const auto spheres = [&](const NearList& list, std::size_t at) {
    return together(list.sphere_a[at], list.sphere_b[at]);
  };
  std::size_t k = 0;
  for (std::size_t was = 0; was < old.count; ++was) {
    if (!old.touched(was)) continue;
    const std::int64_t of_bodies = bodies(old, was), of_spheres = spheres(old, was);
    while (k < count && (bodies(*this, k) < of_bodies ||
                         (bodies(*this, k) == of_bodies && spheres(*this, k) < of_spheres)))
      ++k;
    if (k == count) break;
    if (spheres(*this, k) != of_spheres) continue;
    copy_history(old, was, k);
    touching[k / kBlock] = static_cast<std::uint8_t>(touching[k / kBlock] | (1U << (k % kBlock)));
  }
}

}  // namespace repose
