#include "engine/dynamics/shares.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace repose::test {
namespace {

/// Sections of 128 bodies with a hundred near pairs each.
std::vector<Section> like_sections(std::size_t n) {
  std::vector<Section> sections;
  for (std::size_t s = 0; s < n; ++s) {
    sections.emplace_back(s * Section::kBodies, false);
    sections.back().last = (s + 1) * Section::kBodies;
    sections.back().near_pairs.count = 100;
  }
  return sections;
}

TEST(Shares, DealOutAllSectionsEvenlyAndInOrder) {
  const std::vector<Section> sections = like_sections(20);
  for (const std::size_t members : {1U, 2U, 3U, 7U, 25U}) {
    std::vector<Share> shares(members);
    deal_out(sections, {}, shares);
    for (const auto row : {&Share::pairs, &Share::motion}) {
      std::size_t next = 0;
      for (const Share& share : shares) {
        EXPECT_EQ((share.*row).first, next);
        next = (share.*row).last;
        EXPECT_LE(next - (share.*row).first, 20 / members + 1);
      }
      EXPECT_EQ(next, 20U);
    }
  }
}

TEST(Shares, FollowTheTimesThatStepsHaveTaken) {
  // The last ten of twenty like sections take twice as long as the first ten: half of all time, 15, is that
  // of the first twelve or thirteen.
  const std::vector<Section> sections = like_sections(20);
  std::vector<Share> shares(2);
  deal_out(sections, {}, shares);
  EXPECT_EQ(shares[0].pairs.last, 10U);
  for (int deal = 0; deal < 30; ++deal) {
    for (Share& share : shares)
      for (std::size_t s = share.pairs.first; s < share.pairs.last; ++s)
        share.pairs.taken += s < 10 ? 1.0 : 2.0;
    deal_out(sections, {}, shares);
  }
  EXPECT_GE(shares[0].pairs.last, 12U);
  EXPECT_LE(shares[0].pairs.last, 13U);
  EXPECT_EQ(shares[0].motion.last, 10U);  // of which no times are known
}

}  // namespace
}  // namespace repose::test
