#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/dynamics/candidates.hpp"
#include "engine/dynamics/contact_block.hpp"

namespace repose::test {
namespace {

using Spheres = std::pair<std::int32_t, std::int32_t>;
using Memory = std::map<Spheres, double>;  ///< of the contacts that touch

Memory memory_of(const NearList& list) {
  Memory memory;
  list.for_each_touched([&](const NearList&, std::size_t k) {
    const double value = list.spring[k].value[0];
    memory[{list.sphere_a[k], list.sphere_b[k]}] = value;
    if (list.rolls) {
      EXPECT_EQ(list.rolling[k].torque[1], -value);
    }
  });
  return memory;
}

/// Candidates between bodies i > j, two spheres a body (2 i + 1 and 2 i + 2), sorted by bodies and then
/// spheres, each near with probability 0.6.
struct Candidates {
  CandidateArrays arrays;
  std::vector<BodyPair> bodies;
  std::vector<std::size_t> begin{0};

  void gather_into(NearList& list, const NearList& old) const { list.gather(arrays, begin, bodies, old); }
};

Candidates random_candidates(RandomStream& random, int bodies) {
  Candidates candidates;
  for (int i = 0; i < bodies; ++i)
    for (int j = 0; j < i; ++j) {
      for (int a = 1; a <= 2; ++a)
        for (int b = 1; b <= 2; ++b)
          if (random.uniform() >= 0.3)
            candidates.arrays.push(2 * i + a, 2 * j + b, random.uniform() < 0.6 ? 1 : 0);
      candidates.bodies.push_back({i, j});
      candidates.begin.push_back(candidates.arrays.count());
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
  for (const bool rolls : {false, true})
    for (int trial = 0; trial < 100; ++trial) {
      const Candidates before = random_candidates(random, 6), after = random_candidates(random, 6);
      NearList old(false, rolls), list(false, rolls);
      before.gather_into(old, list);
      touch_some(random, old);
      const Memory was = memory_of(old);
      Memory expected;
      for (std::size_t c = 0; c < after.arrays.count(); ++c) {
        const Spheres key(after.arrays.a[c], after.arrays.b[c]);
        if (after.arrays.near[c] != 0 && was.contains(key)) expected.insert(*was.find(key));
      }
      after.gather_into(list, old);
      EXPECT_EQ(memory_of(list), expected);
      for (std::size_t k = 0; k < list.count; ++k) {
        EXPECT_EQ(list.body_a[k], NearList::kLine * ((list.sphere_a[k] - 1) / 2));
        EXPECT_EQ(list.body_b[k], NearList::kLine * ((list.sphere_b[k] - 1) / 2));
      }
    }
}

TEST(NearList, AppendedContactsAreRememberedByTheNextGathering) {
  RandomStream random(6, 11);
  for (const bool rolls : {false, true})
    for (int trial = 0; trial < 100; ++trial) {
      const Candidates candidates = random_candidates(random, 6);
      NearList old(false, rolls), list(false, rolls), kept(false, rolls);
      candidates.gather_into(old, list);
      touch_some(random, old);
      old.for_each_touched([&](const NearList& from, std::size_t k) {
        const BodyPair bodies{static_cast<int>(from.first_body(k)), static_cast<int>(from.second_body(k))};
        kept.append(from.sphere_a[k], from.sphere_b[k], bodies, from, k);
      });
      EXPECT_EQ(memory_of(kept), memory_of(old));
      candidates.gather_into(list, kept);
      EXPECT_EQ(memory_of(list), memory_of(old));
    }
}

TEST(NearList, CandidatesThatBeginToTouchRememberNothing) {
  RandomStream random(7, 11);
  NearList list(false, true);
  random_candidates(random, 6).gather_into(list, NearList(false, true));
  touch_some(random, list);
  const unsigned before = list.touching[0];
  for (std::size_t k = 0; k < NearList::kBlock; ++k) list.spring[k].value[0] = 1.0 + static_cast<double>(k);
  mark_touching(list, 0, 0xff);
  for (std::size_t k = 0; k < NearList::kBlock; ++k)
    EXPECT_EQ(list.spring[k].value[0], (before >> k & 1U) != 0 ? 1.0 + static_cast<double>(k) : 0.0);
  EXPECT_EQ(list.touching[0], 0xff);
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
