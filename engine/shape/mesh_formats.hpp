#pragma once

#include <string>
#include <vector>

#include "engine/base/input_error.hpp"
#include "engine/shape/mesh.hpp"

namespace repose {

/// A file as it stands: corners not yet joined, unit not yet known. Corners of a facet that could not be read
/// are NaN.
struct RawMesh {
  std::vector<Vec3> vertices;
  std::vector<Facet> facets;
  std::string header;  ///< STL header or comments, where a unit may stand
};

/// The text with every letter from A to Z made small: keywords and extensions are read in either case.
std::string lower(std::string text);

// Each adds what is wrong with the text to `faults`, under the name `file`.
RawMesh parse_stl(const std::string& bytes, const std::string& file, Faults& faults);
RawMesh parse_obj(const std::string& text, const std::string& file, Faults& faults);
RawMesh parse_ply(const std::string& text, const std::string& file, Faults& faults);

}  // namespace repose
