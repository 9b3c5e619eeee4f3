#pragma once

#include <span>

#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/section.hpp"

namespace repose {

/// What a step found in one section.
struct SectionTally {
  ContactWork work;
  double rolling_loss = 0.0;  ///< what integrate() returns [J]
  std::size_t pairs_touching = 0;
};

/// What one member of a crew does in a step: sections first … last − 1, with room to work.
struct Share {
  std::size_t first = 0, last = 0;
  TouchingList touching;
  TouchingWalls touching_walls;
  LoadsBeyond beyond;
};

/// Deals all sections out as neighbours, with about the same work for each share by what the last step found.
/// @param tallies  of the last step, one a section; a section that is new may have none yet
void deal_out(std::span<const Section> sections, std::span<const SectionTally> tallies,
              std::span<Share> shares);

}  // namespace repose
