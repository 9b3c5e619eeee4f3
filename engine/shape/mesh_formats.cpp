#include "engine/shape/mesh_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "engine/base/csv.hpp"

namespace repose {

namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kRecord = 50;

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

float float_at(const char* bytes) {
  const std::uint32_t bits = little_endian(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void add_facet(RawMesh& mesh, const std::array<Vec3, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.facets.push_back({first, first + 1, first + 2});
}

RawMesh binary_stl(const std::string& bytes) {
  RawMesh mesh;
  mesh.header = bytes.substr(0, kHeader);
  for (std::size_t at = kHeader + 4; at + kRecord <= bytes.size(); at += kRecord) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<double>(float_at(&bytes[at + 12 + 4 * k]));
    add_facet(mesh, corners);
  }
  return mesh;
}

/// A coordinate; NaN where the word is no finite number, which the checks then name with its facet.
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

RawMesh ascii_stl(const std::string& text, const std::string& file, Faults& faults) {
  RawMesh mesh;
  mesh.header = text.substr(0, text.find('\n'));
  std::istringstream words(text.substr(mesh.header.size()));
  std::vector<Vec3> corners;
  bool ended = false;
  for (std::string word; words >> word;) {
    word = lower(word);
    if (word == "vertex") corners.push_back(next_point(words));
    if (word == "endsolid") ended = true;
    if (word != "endfacet") continue;
    if (corners.size() == 3)
      add_facet(mesh, {corners[0], corners[1], corners[2]});
    else
      faults.add(file, fmt::format("facet {}", mesh.facets.size() + 1),
                 fmt::format("{} vertices", corners.size()), "must have three");
    corners.clear();
  }
  if (!ended)
    faults.add(file, fmt::format("facet {}", mesh.facets.size() + 1), "",
               "is cut off: the file ends without 'endsolid'");
  return mesh;
}

/// Corners of a polygon, cut into a fan of triangles; corners that do not exist are a fault.
void add_polygon(RawMesh& mesh, const std::vector<long>& corners, const std::string& file, Faults& faults) {
  const std::string where = fmt::format("facet {}", mesh.facets.size() + 1);
  if (corners.size() < 3) {
    faults.add(file, where, fmt::format("{} corners", corners.size()), "must have at least three");
    return;
  }
  for (const long corner : corners) {
    if (corner < 0 || corner >= std::ssize(mesh.vertices)) {
      faults.add(file, where, fmt::format("corner {}", corner), "is not among the vertices");
      return;
    }
  }
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    mesh.facets.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[k]),
                           static_cast<std::uint32_t>(corners[k + 1])});
}

}  // namespace

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

RawMesh parse_stl(const std::string& bytes, const std::string& file, Faults& faults) {
  const std::size_t announced = bytes.size() >= kHeader + 4 ? little_endian(&bytes[kHeader]) : 0;
  if (bytes.size() >= kHeader + 4 && bytes.size() == kHeader + 4 + announced * kRecord)
    return binary_stl(bytes);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  const bool is_text = bytes.find('\0') == std::string::npos;
  if (is_text && start != std::string::npos && lower(bytes.substr(start, 5)) == "solid")
    return ascii_stl(bytes.substr(start), file, faults);
  if (is_text || bytes.size() < kHeader + 4)
    faults.add(file, "", "",
               "is no STL file: neither 'solid …' nor a binary header with as many facets as it announces");
  else
    faults.add(file, fmt::format("facet {}", (bytes.size() - kHeader - 4) / kRecord + 1), "",
               fmt::format("is cut off: the header announces {} facets, {} bytes; the file has {}", announced,
                           kHeader + 4 + announced * kRecord, bytes.size()));
  return {};
}

RawMesh parse_obj(const std::string& text, const std::string& file, Faults& faults) {
  RawMesh mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") mesh.vertices.push_back(next_point(words));
    if (key.starts_with('#')) mesh.header += line + "\n";
    if (key != "f") continue;
    std::vector<long> corners;
    for (std::string word; words >> word;) {
      // v, v/vt, v//vn or v/vt/vn; negative numbers count back from the last vertex.
      const double index = coordinate(word.substr(0, word.find('/')));
      const long number = std::isfinite(index) ? std::lround(index) : 0;
      corners.push_back(number < 0 ? std::ssize(mesh.vertices) + number : number - 1);
    }
    add_polygon(mesh, corners, file, faults);
  }
  return mesh;
}

RawMesh parse_ply(const std::string& text, const std::string& file, Faults& faults) {
  RawMesh mesh;
  std::istringstream lines(text);
  std::string line;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  bool header_ended = false;
  std::getline(lines, line);
  if (!line.starts_with("ply")) faults.add(file, "line 1", "", "is no PLY file: must begin with 'ply'");
  while (!header_ended && std::getline(lines, line)) {
    std::istringstream words(line);
    std::string key;
    std::string name;
    words >> key >> name;
    if (key == "comment") mesh.header += line + "\n";
    if (key == "format" && name != "ascii") faults.add(file, "", name, "only PLY of format ascii is read");
    if (key == "element" && name == "vertex") words >> vertices;
    if (key == "element" && name == "face") words >> faces;
    header_ended = key == "end_header";
  }
  if (!faults.empty()) return mesh;
  const auto next_line = [&](const std::string& what, std::size_t number) {
    while (std::getline(lines, line))
      if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    faults.add(file, fmt::format("{} {}", what, number + 1), "", "is cut off: the file ends before it");
    return false;
  };
  for (std::size_t i = 0; i < vertices && next_line("vertex", i); ++i) {
    std::istringstream words(line);
    mesh.vertices.push_back(next_point(words));
  }
  for (std::size_t i = 0; faults.empty() && i < faces && next_line("facet", i); ++i) {
    std::istringstream words(line);
    std::size_t count = 0;
    words >> count;
    std::vector<long> corners;
    for (long corner = 0; corners.size() < count && words >> corner;) corners.push_back(corner);
    add_polygon(mesh, corners, file, faults);
  }
  return mesh;
}

}  // namespace repose
