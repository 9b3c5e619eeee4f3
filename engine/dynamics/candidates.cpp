#include "engine/dynamics/candidates.hpp"

namespace repose {

void CandidateArrays::clear() {
  a.clear(), b.clear(), spring.clear(), rolling.clear(), touching.clear(), near.clear();
  count = 0;
}

void CandidateArrays::push(std::int32_t first, std::int32_t second, const CandidateArrays& old,
                           std::ptrdiff_t from) {
  const auto source = static_cast<std::size_t>(from);
  const bool known = from >= 0, remembers = known && old.touching[source];
  a.push_back(first);
  b.push_back(second);
  spring.push_back(remembers ? old.spring[source] : SpringRecord{});
  if (rolls) rolling.push_back(remembers ? old.rolling[source] : RollingRecord{});
  touching.push(count, remembers);
  near.push(count, known && old.near[source]);
  ++count;
}

void CandidateArrays::forget(std::size_t candidate) {
  touching.set(candidate, false);
  spring[candidate] = {};
  if (rolls) rolling[candidate] = {};
}

void NearList::gather(CandidateArrays& candidates, const std::vector<PlacedSphere>& placed, bool of_walls) {
  const std::size_t room = candidates.count + kBlock;
  for (auto* array : {&history, &sphere_a, &sphere_b, &body_a, &body_b})
    if (array->size() < room) array->resize(room + room / 2);
  touching.clear();
  count = 0;
  const auto body_of = [&](std::int32_t sphere) {
    return kLine * placed[static_cast<std::size_t>(sphere)].body;
  };
  const auto set = [&](std::size_t k, std::size_t c, std::int32_t a, std::int32_t b) {
    history[k] = kRecord * static_cast<std::int32_t>(c);
    sphere_a[k] = kLine * a, body_a[k] = body_of(a);
    sphere_b[k] = of_walls ? b : kLine * b, body_b[k] = of_walls ? 0 : body_of(b);
  };
  for (std::size_t w = 0; w < candidates.near.words(); ++w) {
    const std::uint64_t bits = candidates.near.word(w);
    const std::uint64_t touched = candidates.touching.word(w);
    BitRow::for_each(w, touched & ~bits, [&](std::size_t c) { candidates.forget(c); });
    BitRow::for_each(w, bits, [&](std::size_t c) {
      set(count, c, candidates.a[c], candidates.b[c]);
      if (count % kBlock == 0) touching.push_back(0);
      const auto bit = static_cast<unsigned>((touched >> (c % BitRow::kWord)) & 1U);
      touching.back() = static_cast<std::uint8_t>(touching.back() | (bit << (count % kBlock)));
      ++count;
    });
  }
  for (std::size_t k = count; k < blocks() * kBlock; ++k) set(k, 0, 0, 0);
}

}  // namespace repose
