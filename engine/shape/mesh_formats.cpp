#include "engine/shape/mesh_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <istream>
#include <limits>

#include "engine/base/csv.hpp"

namespace repose {

std::string FacetPlace::text() const {
  return line == 0 ? fmt::format("facet {}", number) : fmt::format("face {} (line {})", number, line);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string unix_lines(const std::string& text) {
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  }
  return lines;
}

double coordinate(const std::string& word) {
  return parse_number(word).value_or(std::numeric_limits<double>::quiet_NaN());
}

Vec3 next_point(std::istream& words) {
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::string word;
  for (double& value : point)
    if (words >> word) value = coordinate(word);
  return point;
}

void add_polygon(RawMesh& mesh, const std::vector<long>& corners, const FacetPlace& place, long first,
                 FaultKind& faults) {
  if (corners.size() < 3) {
    faults.add(place.text(), fmt::format("{} corners", corners.size()), "must have at least three");
    return;
  }
  for (const long corner : corners) {
    if (corner < 0 || corner >= std::ssize(mesh.vertices)) {
      faults.add(place.text(), fmt::format("corner {}", corner + first), "is not among the vertices");
      return;
    }
  }
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    mesh.add({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[k]),
              static_cast<std::uint32_t>(corners[k + 1])},
             place);
}

}  // namespace repose
