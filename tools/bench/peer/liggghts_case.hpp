#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/scene/scene.hpp"

namespace repose::peer {

/// When the stages of a run begin, as Repose found them [s of simulated time].
struct Schedule {
  double opening = 0.0;  ///< the column has settled
  double end = 0.0;      ///< the heap has come to rest
};

/// Files of a run's folder.
inline constexpr const char* kInputFile = "in.slump";
inline constexpr const char* kColumnDump = "column.dump";
inline constexpr const char* kHeapDump = "heap.dump";

/// Writes what LIGGGHTS needs for the same test into a folder: its input script, the walls as facets and the
/// spheres of the clumps. The same particles by number, mass and inertia, the same material, laws, time step,
/// rate, speed and height of the pour; the stages last as long as they did in Repose.
/// Throws InputError, with every fault, where LIGGGHTS has no counterpart: other rolling models, histories or
/// dampings, sizes from a range, spheres mixed with clumps.
void write_liggghts_case(const Scene& scene, std::uint64_t seed, const Schedule& schedule,
                         const std::filesystem::path& folder);

/// The smallest prime above 10000 + 1000 n: LIGGGHTS takes no other seeds.
std::uint64_t prime_seed(std::uint64_t n);

}  // namespace repose::peer
