#pragma once

#include <filesystem>
#include <vector>

#include "engine/output/heap_files.hpp"
#include "engine/scene/heap_snapshot.hpp"
#include "engine/scene/scene.hpp"

namespace repose::program {

/// Writes a given number of instants of a test whose length nobody knows beforehand, evenly spread over all
/// of it, as a series that ParaView plays; what is there plays at any time.
///
/// It is given many snapshots at equal intervals. Whenever twice the wanted number has come together, every
/// second one is removed again, and from then on only every second one is taken.
class FrameWriter {
 public:
  /// @param frames  wanted, ≥ 1
  FrameWriter(const std::filesystem::path& folder, const Scene& scene, int frames);

  /// Simulated time between the snapshots that add() should be given [s].
  [[nodiscard]] double interval() const { return interval_; }
  void add(const HeapSnapshot& heap);
  /// Ends the series with the end of the test and leaves the wanted number.
  void finish(const HeapSnapshot& end);

 private:
  std::size_t wanted_;
  double interval_;
  std::size_t seen_ = 0;
  std::size_t stride_ = 1;
  double last_time_ = -1.0;
  FrameSeries series_;
};

/// One flag for each of 0 … count − 1: `wanted` of them set, evenly spread, the first and the last among
/// them; all where there are no more than that; only the last for one.
std::vector<char> evenly_spread(std::size_t count, std::size_t wanted);

}  // namespace repose::program
