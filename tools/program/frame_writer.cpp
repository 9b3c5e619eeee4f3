#include "tools/program/frame_writer.hpp"

namespace repose::program {

namespace {

/// Shorter than any test: pouring alone, and half a second to settle, open and come to rest [s].
double shortest_duration(const Scene& scene) {
  return scene.particles.total_mass / scene.test.pour_rate + 0.5;
}

}  // namespace

std::vector<char> evenly_spread(std::size_t count, std::size_t wanted) {
  std::vector<char> keep(count, 0);
  const std::size_t taken = std::min(count, wanted);
  for (std::size_t i = 0; i < taken; ++i)
    keep[taken == 1 ? count - 1 : (i * (count - 1) + (taken - 1) / 2) / (taken - 1)] = 1;
  return keep;
}

FrameWriter::FrameWriter(const std::filesystem::path& folder, const Scene& scene, int frames)
    : wanted_(static_cast<std::size_t>(frames)),
      interval_(shortest_duration(scene) / (2.0 * frames)),
      series_(folder, "film") {}

void FrameWriter::add(const HeapSnapshot& heap) {
  if (seen_++ % stride_ != 0) return;
  series_.add(heap);
  last_time_ = heap.time;
  if (series_.size() < 2 * wanted_ + 1) return;
  // 2 n + 1 frames at 0, 1 … 2 n strides: those at even strides stay.
  std::vector<char> keep(series_.size(), 0);
  for (std::size_t i = 0; i < keep.size(); i += 2) keep[i] = 1;
  series_.retain(keep);
  stride_ *= 2;
}

void FrameWriter::finish(const HeapSnapshot& end) {
  if (end.time > last_time_) series_.add(end);
  series_.retain(evenly_spread(series_.size(), wanted_));
}

}  // namespace repose::program
