#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/dynamics/candidates.hpp"

namespace repose::test {
namespace {

/// Spheres 1 … n behind the dummy, two a body.
std::vector<PlacedSphere> spheres_of_two(int n) {
  std::vector<PlacedSphere> placed(static_cast<std::size_t>(n) + 1);
  for (int s = 1; s <= n; ++s) placed[static_cast<std::size_t>(s)].body = (s - 1) / 2;
  return placed;
}

using Spheres = std::pair<std::size_t, std::size_t>;
using Memory = std::map<Spheres, double>;  ///< of the contacts that touch

Memory memory_of(const NearList& list) {
  Memory memory;
  for (std::size_t k = 0; k < list.count; ++k) {
    const double value = list.spring[k].value[0];
    if (list.touched(k))
      memory[{list.first(k), list.second(k)}] = value;
    else
      EXPECT_EQ(value, 0.0);
    if (list.rolls) {
      EXPECT_EQ(list.rolling[k].torque[1], -value);
    }
  }
  return memory;
}

/// Candidates between bodies i > j, sorted by bodies and then spheres, each near with probability 0.6.
CandidateArrays random_candidates(RandomStream& random, int bodies) {
  CandidateArrays candidates;
  for (int i = 0; i < bodies; ++i)
    for (int j = 0; j < i; ++j)
      for (int a = 1; a <= 2; ++a)
        for (int b = 1; b <= 2; ++b) {
          if (random.uniform() < 0.3) continue;
          candidates.push(2 * i + a, 2 * j + b);
          candidates.set_near(candidates.count() - 1, 1, random.uniform() < 0.6 ? 1U : 0U);
        }
  return candidates;
}

void touch_some(RandomStream& random, NearList& list) {
  for (std::size_t k = 0; k < list.count; ++k) {
    if (random.uniform() < 0.5) continue;
    list.touching[k / NearList::kBlock] =
        static_cast<std::uint8_t>(list.touching[k / NearList::kBlock] | (1U << (k % NearList::kBlock)));
    list.spring[k].value[0] = random.uniform() + 0.1;
    if (list.rolls) list.rolling[k].torque[1] = -list.spring[k].value[0];
  }
}

TEST(NearList, ContactsThatStayNearRememberAndNoOthers) {
  RandomStream random(5, 11);
  const std::vector<PlacedSphere> placed = spheres_of_two(12);
  for (const bool rolls : {false, true})
    for (int trial = 0; trial < 100; ++trial) {
      const CandidateArrays before = random_candidates(random, 6), after = random_candidates(random, 6);
      NearList old(false, rolls), list(false, rolls);
      old.gather(before, placed, list);
      touch_some(random, old);
      Memory expected;
      for (std::size_t c = 0; c < after.count(); ++c) {
        const Spheres key(after.a[c], after.b[c]);
        const Memory was = memory_of(old);
        if (after.near[c] != 0 && was.contains(key)) expected.insert(*was.find(key));
      }
      list.gather(after, placed, old);
      EXPECT_EQ(memory_of(list), expected);
    }
}

TEST(NearList, AppendedContactsAreRememberedByTheNextGathering) {
  RandomStream random(6, 11);
  const std::vector<PlacedSphere> placed = spheres_of_two(12);
  for (const bool rolls : {false, true})
    for (int trial = 0; trial < 100; ++trial) {
      const CandidateArrays candidates = random_candidates(random, 6);
      NearList old(false, rolls), list(false, rolls), kept(false, rolls);
      old.gather(candidates, placed, list);
      touch_some(random, old);
      old.for_each_touched([&](const NearList& from, std::size_t k) {
        kept.append(static_cast<std::int32_t>(from.first(k)), static_cast<std::int32_t>(from.second(k)),
                    placed, from, k);
      });
      EXPECT_EQ(memory_of(kept), memory_of(old));
      list.gather(candidates, placed, kept);
      EXPECT_EQ(memory_of(list), memory_of(old));
    }
}

TEST(NearList, VisitsEveryFlagThatIsSet) {
  RandomStream random(8, 11);
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<std::uint8_t> flags(n);
    std::vector<std::size_t> expected, visited;
    for (std::size_t k = 0; k < n; ++k) {
      flags[k] = random.uniform() < 0.3 ? 1 : 0;
      if (flags[k] != 0) expected.push_back(k);
    }
    for_each_flag(flags, [&](std::size_t k) { visited.push_back(k); });
    EXPECT_EQ(visited, expected);
  }
}

}  // namespace
}  // namespace repose::test
