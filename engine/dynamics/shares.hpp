#pragma once

#include <chrono>
#include <span>

#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/section.hpp"

namespace repose {

/// What a step found in one section.
struct SectionTally {
  ContactWork work;
  double rolling_loss = 0.0;  ///< what integrate() returns [J]
  std::size_t pairs_touching = 0, walls_touching = 0;
};

/// Sections first … last − 1, of which one member does a part of the step.
struct SectionRow {
  std::size_t first = 0, last = 0;
  double work = 0.0;   ///< what a step of it is thought to take, when it was dealt out [s]
  double taken = 0.0;  ///< what steps since have taken [s]
  double price = 1.0;  ///< what its work takes over what that of all takes, as far as is known
  [[nodiscard]] bool empty() const { return first == last; }
};

/// Adds the time of a block to SectionRow::taken.
class RowTimer {
 public:
  explicit RowTimer(SectionRow& row) : row_(row) {}
  ~RowTimer() {
    row_.taken += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  RowTimer(const RowTimer&) = delete;
  RowTimer& operator=(const RowTimer&) = delete;

 private:
  SectionRow& row_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// What one member of a crew does in a step, with room to work.
struct Share {
  SectionRow pairs;   ///< whose spheres it places and whose pairs of bodies it works through
  SectionRow motion;  ///< whose contacts with walls it works through and whose bodies it moves
  TouchingList touching;
  TouchingWalls touching_walls;
  LoadsBeyond beyond;
};

/// Deals all sections out as neighbours, pairs and motion each for itself, since members meet between them:
/// with about the same work for each share by what the last step found, and by what steps have taken since
/// the last deal.
/// @param tallies  of the last step, one a section; a section that is new may have none yet
void deal_out(std::span<const Section> sections, std::span<const SectionTally> tallies,
              std::span<Share> shares);

}  // namespace repose
