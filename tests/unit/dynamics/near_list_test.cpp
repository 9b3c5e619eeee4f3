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

/// Candidates between bodies i < j, sorted by bodies and then spheres, each near with probability 0.6.
CandidateArrays random_candidates(RandomStream& random, int bodies) {
  CandidateArrays candidates;
  for (int i = 0; i < bodies; ++i)
    for (int j = i + 1; j < bodies; ++j)
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

TEST(NearList, RenumberingDropsContactsOfBodiesThatGoAndKeepsTheOthers) {
  RandomStream random(6, 11);
  NearList list(false, true);
  list.gather(random_candidates(random, 6), spheres_of_two(12), NearList(false, true));
  touch_some(random, list);
  const Memory before = memory_of(list);
  // Body 2 (spheres 5 and 6) goes; the spheres behind move down by two.
  const auto new_place = [](std::int32_t sphere) {
    return sphere == 5 || sphere == 6 ? -1 : (sphere > 6 ? sphere - 2 : sphere);
  };
  Memory expected;
  for (const auto& [spheres, value] : before) {
    const int a = new_place(static_cast<std::int32_t>(spheres.first)),
              b = new_place(static_cast<std::int32_t>(spheres.second));
    if (a > 0 && b > 0) expected[{static_cast<std::size_t>(a), static_cast<std::size_t>(b)}] = value;
  }
  ASSERT_LT(expected.size(), before.size());
  list.renumber(new_place, spheres_of_two(10));
  EXPECT_EQ(memory_of(list), expected);
}

}  // namespace
}  // namespace repose::test
