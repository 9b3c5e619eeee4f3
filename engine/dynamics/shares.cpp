#include "engine/dynamics/shares.hpp"

#include <cmath>

namespace repose {

namespace {

double times(double price, std::size_t count) { return price * static_cast<double>(count); }

// Time of a section's step in nanoseconds, roughly, as on the machine of tools/bench/NOTES.md; only ratios
// count.

double work_of_pairs(const Section& section, const SectionTally& tally) {
  return times(5.0, section.needed.size()) + times(3.0, section.near_pairs.count) +
         times(45.0, tally.pairs_touching);
}

double work_of_motion(const Section& section, const SectionTally& tally) {
  return times(25.0, section.last - section.first) + times(6.0, section.near_walls.count) +
         times(40.0, tally.walls_touching);
}

template <class Work>
void deal(std::span<const Section> sections, std::span<const SectionTally> tallies, std::span<Share> shares,
          SectionRow Share::*row, Work work_of) {
  const auto work = [&](std::size_t s) {
    return work_of(sections[s], s < tallies.size() ? tallies[s] : SectionTally{});
  };
  double all = 0.0;
  for (std::size_t s = 0; s < sections.size(); ++s) all += work(s);
  // A share ends where the sum is nearest to its part of the whole.
  double sum = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double end = all * static_cast<double>(k + 1) / static_cast<double>(shares.size());
    (shares[k].*row).first = next;
    while (next < sections.size() && std::abs(sum + work(next) - end) <= std::abs(sum - end))
      sum += work(next++);
    if (k + 1 == shares.size()) next = sections.size();
    (shares[k].*row).last = next;
  }
}

}  // namespace

void deal_out(std::span<const Section> sections, std::span<const SectionTally> tallies,
              std::span<Share> shares) {
  deal(sections, tallies, shares, &Share::pairs, work_of_pairs);
  deal(sections, tallies, shares, &Share::motion, work_of_motion);
}

}  // namespace repose
