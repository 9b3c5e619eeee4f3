#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "engine/shape/clump.hpp"

namespace repose {

/// Shapes that have been read or made, so that the scenes of a sweep share one reading. Not for several
/// threads at once. A file that changes while a cache lives is not read again.
class ShapeCache {
 public:
  /// The clump of a clump file. Throws InputError as read_clump() does.
  const Clump& clump(const std::filesystem::path& file);

  /// The clump of so many spheres that stands for the mesh of a file; takes seconds where it has to be made.
  /// Throws InputError as read_mesh() and generate_clump() do.
  const Clump& clump_of_mesh(const std::filesystem::path& file, int spheres);

 private:
  std::map<std::pair<std::string, int>, Clump>
      clumps_;  ///< by file and number of spheres, 0 for a clump file
};

}  // namespace repose
