#include "engine/dynamics/shares.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace repose {

namespace {

/// @param price  [ns]
double times(double price, std::size_t count) { return 1e-9 * price * static_cast<double>(count); }

// Time of a section's step, roughly, as on the machine of tools/bench/NOTES.md; only ratios count.

double work_of_pairs(const Section& section, const SectionTally& tally) {
  return times(5.0, section.needed.size()) + times(3.0, section.near_pairs.count) +
         times(45.0, tally.pairs_touching);
}

double work_of_motion(const Section& section, const SectionTally& tally) {
  return times(25.0, section.last - section.first) + times(6.0, section.near_walls.count) +
         times(40.0, tally.walls_touching);
}

/// Prices move a part of the way towards what was measured, within limits: a thread that was put to sleep
/// says nothing about its sections.
void learn_prices(std::span<Share> shares, SectionRow Share::*row) {
  constexpr double kPart = 0.3, kLeast = 0.5, kMost = 2.0;
  double work = 0.0, taken = 0.0;
  for (const Share& share : shares) work += (share.*row).work, taken += (share.*row).taken;
  for (Share& share : shares) {
    SectionRow& of = share.*row;
    if (of.work > 0.0 && of.taken > 0.0)
      of.price += kPart * (std::clamp((of.taken / of.work) / (taken / work), kLeast, kMost) - of.price);
    of.taken = 0.0;
  }
}

template <class Work>
void deal(std::span<const Section> sections, std::span<const SectionTally> tallies, std::span<Share> shares,
          SectionRow Share::*row, Work work_of) {
  learn_prices(shares, row);
  std::vector<double> work(sections.size());
  double all = 0.0;
  std::size_t owner = 0;  // of section s before; a new one is priced as the last
  for (std::size_t s = 0; s < sections.size(); ++s) {
    while (owner + 1 < shares.size() && (shares[owner].*row).last <= s) ++owner;
    work[s] = work_of(sections[s], s < tallies.size() ? tallies[s] : SectionTally{});
    work[s] *= (shares[owner].*row).price;
    all += work[s];
  }
  // A share ends where the sum is nearest to its part of the whole.
  double sum = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    SectionRow& to = shares[k].*row;
    const double begin = sum, end = all * static_cast<double>(k + 1) / static_cast<double>(shares.size());
    to.first = next;
    while (next < sections.size() && std::abs(sum + work[next] - end) <= std::abs(sum - end))
      sum += work[next++];
    if (k + 1 == shares.size()) next = sections.size();
    to.last = next;
    to.work = (sum - begin) / to.price;
  }
}

}  // namespace

void deal_out(std::span<const Section> sections, std::span<const SectionTally> tallies,
              std::span<Share> shares) {
  deal(sections, tallies, shares, &Share::pairs, work_of_pairs);
  deal(sections, tallies, shares, &Share::motion, work_of_motion);
}

}  // namespace repose
