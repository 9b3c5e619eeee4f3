#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/candidates.hpp"
#include "engine/dynamics/cell_grid.hpp"
#include "engine/dynamics/tether.hpp"

namespace repose {

/// Bodies of neighbouring numbers with everything that may touch them: the piece of work that threads share a
/// step by. A pair of bodies belongs to the section of its first, which has the greater number. What a
/// section holds and the order in which it is worked through follow from the bodies alone, so that sums of
/// its own are the same bits whoever makes them.
struct Section {
  /// Bodies of a section; a multiple of the padding of Bodies. A smaller number shares out more evenly, a
  /// larger one leaves fewer vectors half full. Measured in tools/bench/NOTES.md.
  static constexpr std::size_t kBodies = 128;

  /// Levels 1 and 2 of ContactList.
  struct Lists {
    std::vector<BodyPair> body_pairs;  ///< sorted
    std::vector<Tether> listed;        ///< of each body pair, while its candidates are all that may touch
    std::vector<Tether> looked;        ///< the same, while the near ones are
    std::vector<CandidateSlot> pair_slots;
    CandidateArrays pairs;
    std::vector<CandidateSlot> wall_slots;  ///< of each body of the section
    CandidateArrays walls;
    void clear();
    void clear_pairs();  ///< all but their candidates
    void swap_pairs(Lists& other);
    void add_pair(const BodyPair& pair, const Tether& listed_then = {}, const Tether& looked_then = {},
                  const CandidateSlot& slot = {});
  };

  /// @param rolls  contacts remember a rolling spring
  Section(std::size_t first, bool rolls)
      : first(first),
        last(first),
        near_pairs(false, rolls),
        near_walls(true, rolls),
        old_near_pairs(false, rolls),
        old_near_walls(true, rolls) {}

  std::size_t first = 0, last = 0;  ///< bodies first … last − 1
  Lists lists;
  NearList near_pairs, near_walls;  ///< level 3
  /// A sphere of these bodies that some near candidate needs.
  struct Needed {
    std::int32_t body = 0;
    std::int32_t local = 0;   ///< row of LocalSpheres
    std::int32_t sphere = 0;  ///< among those of all bodies
  };
  std::vector<Needed> needed;  ///< in the order of their places

  bool changed = false;  ///< which candidates are near, since near_pairs and near_walls were gathered

  // Pairs of bodies that a search has found: of this section, sorted, and of greater numbers.
  std::vector<BodyPair> found, found_above;

  // As they were before the change under way.
  Lists old;  ///< only what the change needs
  NearList old_near_pairs, old_near_walls;

  /// near_pairs and near_walls anew, from the candidates whose `near` is set.
  void gather_near();

 private:
  std::vector<BodyPair> own_bodies_;  ///< each with nothing, as walls' candidates are grouped
};

}  // namespace repose
