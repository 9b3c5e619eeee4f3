#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "engine/shape/clump.hpp"

namespace repose {

/// Shapes that have been read or made, so that the scenes of a sweep share one reading. Not for several
/// threads at once. A file that changes while a cache lives is not read again.
class ShapeCache {
 public:
  /// The clump of a clump file. Throws InputError as read_clump() does.
  const Clump& clump(const std::filesystem::path& file);

  /// The clump of so many spheres that stands for the mesh of a file; takes seconds where it has to be made.
  /// @param metres_per_unit  of the file's numbers; where it is not given read_mesh() tells
  /// Throws InputError as read_mesh() and generate_clump() do.
  const Clump& clump_of_mesh(const std::filesystem::path& file, int spheres,
                             std::optional<double> metres_per_unit);

 private:
  /// By file, number of spheres (0 for a clump file) and unit (0 where none is given).
  std::map<std::tuple<std::string, int, double>, Clump> clumps_;
};

}  // namespace repose
