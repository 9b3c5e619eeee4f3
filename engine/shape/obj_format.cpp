#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>

#include "engine/shape/mesh_formats.hpp"

namespace repose {

namespace {

/// A line with those that a '\' at its end joins to it, without what follows a '#'.
struct ObjLine {
  std::string text;
  std::string comment;  ///< with its '#'
  std::uint32_t number = 0;
};

bool next_line(std::istream& lines, std::uint32_t& read, ObjLine& line) {
  line = {.text = {}, .comment = {}, .number = read + 1};
  std::string part;
  bool continued = true;
  while (continued && std::getline(lines, part)) {
    ++read;
    if (const auto hash = part.find('#'); hash != std::string::npos) {
      line.comment += part.substr(hash);
      part.erase(hash);
    }
    const auto last = part.find_last_not_of(" \t");
    continued = last != std::string::npos && part[last] == '\\';
    if (continued) part.erase(last);
    line.text += part + ' ';
  }
  return read >= line.number;
}

/// The vertex of a corner given as v, v/vt, v//vn or v/vt/vn.
std::optional<long> vertex_number(const std::string& corner) {
  const std::string word = corner.substr(0, corner.find('/'));
  long number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

void read_face(std::istream& words, const FacetPlace& place, RawMesh& mesh, FaultKind& faults) {
  std::vector<long> corners;
  for (std::string word; words >> word;) {
    const std::optional<long> number = vertex_number(word);
    if (!number || *number == 0) {
      faults.add(place.text(), fmt::format("corner '{}'", word),
                 "must begin with the number of a vertex: 1, 2, … or, from the last one back, -1, -2, …");
      return;
    }
    // Negative numbers count back from the last vertex.
    corners.push_back(*number < 0 ? std::ssize(mesh.vertices) + *number : *number - 1);
  }
  add_polygon(mesh, corners, place, 1, faults);
}

}  // namespace

RawMesh parse_obj(const std::string& text, const std::string& file, Faults& faults) {
  RawMesh mesh;
  FaultKind kind(faults, file, "faces");
  std::istringstream lines(unix_lines(text));
  std::uint32_t read = 0;
  std::uint32_t faces = 0;
  for (ObjLine line; next_line(lines, read, line);) {
    std::istringstream words(line.text);
    std::string key;
    words >> key;
    if (key.empty()) mesh.header += line.comment + "\n";
    if (key == "v") mesh.vertices.push_back(next_point(words));
    if (key == "f") read_face(words, {.number = ++faces, .line = line.number}, mesh, kind);
  }
  return mesh;
}

}  // namespace repose
