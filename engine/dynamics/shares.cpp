#include "engine/dynamics/shares.hpp"

#include <cmath>

namespace repose {

namespace {

/// Time of a section's step in nanoseconds, roughly, as on the machine of tools/bench/NOTES.md; only ratios
/// count.
double work_of(const Section& section, std::size_t pairs_touching) {
  const auto times = [](double price, std::size_t count) { return price * static_cast<double>(count); };
  return times(9.0, section.last - section.first) + times(2.0, section.needed.size()) +
         times(1.5, section.near_pairs.count) + times(5.0, section.near_walls.count) +
         times(14.0, pairs_touching);
}

}  // namespace

void deal_out(std::span<const Section> sections, std::span<const SectionTally> tallies,
              std::span<Share> shares) {
  if (shares.size() == 1) {
    shares[0].first = 0, shares[0].last = sections.size();
    return;
  }
  const auto work = [&](std::size_t s) {
    return work_of(sections[s], s < tallies.size() ? tallies[s].pairs_touching : 0);
  };
  double all = 0.0;
  for (std::size_t s = 0; s < sections.size(); ++s) all += work(s);
  // A share ends where the sum is nearest to its part of the whole.
  double sum = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double end = all * static_cast<double>(k + 1) / static_cast<double>(shares.size());
    shares[k].first = next;
    while (next < sections.size() && std::abs(sum + work(next) - end) <= std::abs(sum - end))
      sum += work(next++);
    if (k + 1 == shares.size()) next = sections.size();
    shares[k].last = next;
  }
}

}  // namespace repose
