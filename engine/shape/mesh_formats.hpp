#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/base/input_error.hpp"
#include "engine/shape/fault_kind.hpp"
#include "engine/shape/mesh.hpp"

namespace repose {

/// Where a facet stands in its file.
struct FacetPlace {
  std::uint32_t number = 0;  ///< of the facet or face in the file, from 1
  std::uint32_t line = 0;    ///< 0 where the format has no lines to count

  /// "facet 7", or "face 7 (line 12)" in a format with lines, whose faces may be more than one facet.
  [[nodiscard]] std::string text() const;
};

/// A file as it stands: corners not yet joined, unit not yet known. Corners of a facet that could not be read
/// are NaN.
struct RawMesh {
  std::vector<Vec3> vertices;
  std::vector<Facet> facets;
  std::vector<FacetPlace> places;  ///< one a facet
  std::string header;              ///< STL header or comments, where a unit may stand

  void add(const Facet& facet, const FacetPlace& place) {
    facets.push_back(facet);
    places.push_back(place);
  }
};

/// The text with every letter from A to Z made small: keywords and extensions are read in either case.
std::string lower(std::string text);
/// The text without a byte order mark, every line ended by a line feed alone.
std::string unix_lines(const std::string& text);
/// A coordinate; NaN where the word is no finite number, which the checks then name with its facet.
double coordinate(const std::string& word);
/// The next three words as coordinates.
Vec3 next_point(std::istream& words);
/// Corners of a polygon, cut into a fan of triangles; fewer than three, or one that is not among the vertices
/// (numbered from 0 here, as `first` = 0 or 1 in the file), are a fault.
void add_polygon(RawMesh& mesh, const std::vector<long>& corners, const FacetPlace& place, long first,
                 FaultKind& faults);

// Each adds what is wrong with the text to `faults`, under the name `file`.

/// STL, binary or ASCII, told apart by its length.
RawMesh parse_stl(const std::string& bytes, const std::string& file, Faults& faults);
/// Wavefront OBJ: `v` and `f`, lines continued by '\', comments; everything else is passed over.
RawMesh parse_obj(const std::string& text, const std::string& file, Faults& faults);
/// PLY of format ascii: elements in any order, x, y and z wherever they stand among the properties of a
/// vertex, corners in the list vertex_indices or vertex_index of a face; other elements and properties are
/// passed over. One row a line.
RawMesh parse_ply(const std::string& text, const std::string& file, Faults& faults);

}  // namespace repose
