#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
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
  std::vector<CandidateSlot> slots;

  /// As where nothing is known of the slots.
  void gather_into(NearList& list, const NearList& old) const {
    std::vector<CandidateSlot> changed = slots;
    for (CandidateSlot& slot : changed) slot.changed = true;
    list.gather(arrays, changed, bodies, old);
  }
};

Candidates random_candidates(RandomStream& random, int bodies) {
  Candidates candidates;
  for (int i = 0; i < bodies; ++i)
    for (int j = 0; j < i; ++j) {
      const std::size_t begin = candidates.arrays.count();
      for (int a = 1; a <= 2; ++a)
        for (int b = 1; b <= 2; ++b)
          if (random.uniform() >= 0.3)
            candidates.arrays.push(2 * i + a, 2 * j + b, random.uniform() < 0.6 ? 1 : 0);
      candidates.bodies.push_back({i, j});
      candidates.slots.push_back(candidates.arrays.slot_from(begin));
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

/// Rows of slots that have not changed are copied in blocks from where they were: against a list that is
/// gathered from all slots. Of the pairs of bodies some go, some come, some get other flags.
TEST(NearList, IsTheSameWhereMostOfItIsTakenFromTheOldOne) {
  RandomStream random(12, 11);
  for (const bool rolls : {false, true})
    for (int trial = 0; trial < 300; ++trial) {
      const Candidates candidates = random_candidates(random, 9);
      NearList old(false, rolls), list(false, rolls), expected(false, rolls);
      Candidates before, after;
      before.arrays = after.arrays = candidates.arrays;
      const double part = random.uniform();
      for (std::size_t s = 0; s < candidates.slots.size(); ++s) {
        CandidateSlot slot = candidates.slots[s];  // of a pair that comes: it has changed where one is near
        const double fate = random.uniform() / part;
        if (fate >= 0.2) {
          before.slots.push_back(slot), before.bodies.push_back(candidates.bodies[s]);
          slot.changed = false;
        }
        if (fate >= 0.2 && fate < 0.4) continue;  // the pair goes
        if (fate >= 0.4 && fate < 0.7) {
          slot.near = 0;
          after.arrays.set_near(slot, slot.begin, slot.count,
                                static_cast<unsigned>(256.0 * random.uniform()));
        }
        after.slots.push_back(slot), after.bodies.push_back(candidates.bodies[s]);
      }
      before.gather_into(old, list);
      touch_some(random, old);
      after.gather_into(expected, old);
      list.gather(after.arrays, after.slots, after.bodies, old);
      ASSERT_EQ(list.count, expected.count);
      ASSERT_EQ(list.touching, expected.touching);
      EXPECT_EQ(memory_of(list), memory_of(expected));
      for (std::size_t k = 0; k < list.blocks() * NearList::kBlock; ++k) {
        EXPECT_EQ(list.sphere_a[k], expected.sphere_a[k]);
        EXPECT_EQ(list.sphere_b[k], expected.sphere_b[k]);
        EXPECT_EQ(list.body_a[k], expected.body_a[k]);
        EXPECT_EQ(list.body_b[k], expected.body_b[k]);
      }
      for (const CandidateSlot& slot : after.slots) EXPECT_FALSE(slot.changed);
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

TEST(NearList, VisitsEveryFlagOfARowThatIsSet) {
  RandomStream random(8, 11);
  for (std::size_t n = 0; n < 40; ++n) {
    std::vector<std::uint8_t> flags(n);
    for (std::uint8_t& flag : flags) flag = random.uniform() < 0.3 ? 1 : 0;
    for (std::size_t begin = 0; begin <= n; ++begin)
      for (std::size_t end = begin; end <= n; ++end) {
        std::vector<std::size_t> expected, visited;
        for (std::size_t k = begin; k < end; ++k)
          if (flags[k] != 0) expected.push_back(k);
        for_each_flag(flags, begin, end, [&](std::size_t k) { visited.push_back(k); });
        ASSERT_EQ(visited, expected) << begin << " to " << end << " of " << n;
      }
  }
}

using Row = std::vector<std::tuple<std::int32_t, std::int32_t, std::uint8_t>>;

Row row_of(const CandidateArrays& arrays, const CandidateSlot& slot) {
  Row row;
  for (std::size_t c = slot.begin; c < slot.begin + slot.count; ++c)
    row.emplace_back(arrays.a[c], arrays.b[c], arrays.near[c]);
  return row;
}

/// Random flags for the candidates of a slot. Bits beyond the last are to be passed over.
void look_at(RandomStream& random, CandidateArrays& arrays, CandidateSlot& slot, Row& row) {
  slot.near = 0;
  const auto at_once = static_cast<std::size_t>(1.0 + 8.0 * random.uniform());
  for (std::size_t k = 0; k < slot.count; k += at_once) {
    const auto bits = static_cast<unsigned>(256.0 * random.uniform());
    const std::size_t n = std::min(at_once, slot.count - k);
    arrays.set_near(slot, slot.begin + k, n, bits);
    for (std::size_t c = 0; c < n; ++c) std::get<2>(row[k + c]) = (bits >> c) & 1U;
  }
}

TEST(CandidateArrays, FlagsAndBitsAreTheSame) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const std::uint64_t flags = flags_of(bits);
    for (unsigned k = 0; k < 8; ++k) EXPECT_EQ((flags >> (8 * k)) & 0xff, (bits >> k) & 1U);
    EXPECT_EQ(bits_of(flags), bits);
  }
}

TEST(CandidateArrays, SlotsKeepTheirOwnWhileOthersAreReplaced) {
  RandomStream random(9, 11);
  CandidateArrays arrays;
  std::vector<CandidateSlot> slots(20);
  std::vector<Row> expected(20);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto s = static_cast<std::size_t>(20.0 * random.uniform());
    const std::size_t begin = arrays.count();
    if (trial % 3 == 0)  // flags set by a look
      for (std::size_t k = 0; k < slots.size(); ++k) look_at(random, arrays, slots[k], expected[k]);
    expected[s].clear();
    for (int n = static_cast<int>(9.0 * random.uniform()); n > 0; --n) {
      expected[s].emplace_back(trial, n, n % 2);
      arrays.push(trial, n, static_cast<std::uint8_t>(n % 2));
    }
    arrays.put_last_into(slots[s], begin);
    if (trial % 100 == 99) {
      arrays.close_up(slots);
      EXPECT_FALSE(arrays.is_loose(slots));
      std::size_t all = 0;
      for (const Row& row : expected) all += row.size();
      EXPECT_EQ(arrays.count(), all);
    }
    for (std::size_t k = 0; k < slots.size(); ++k) {
      ASSERT_EQ(row_of(arrays, slots[k]), expected[k]) << trial;
      const auto is_near = [](const auto& candidate) { return std::get<2>(candidate) == 1; };
      ASSERT_EQ(slots[k].near, std::ranges::count_if(expected[k], is_near)) << trial;
    }
  }
}

}  // namespace
}  // namespace repose::test
