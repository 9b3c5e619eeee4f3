#include <fmt/format.h>

#include <array>
#include <cstring>
#include <sstream>

#include "engine/shape/mesh_formats.hpp"

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

void add_facet(RawMesh& mesh, const std::array<Vec3, 3>& corners, std::uint32_t number) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.add({first, first + 1, first + 2}, {.number = number});
}

RawMesh binary_stl(const std::string& bytes) {
  RawMesh mesh;
  mesh.header = bytes.substr(0, kHeader);
  std::uint32_t number = 0;
  for (std::size_t at = kHeader + 4; at + kRecord <= bytes.size(); at += kRecord) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 9; ++k)
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          static_cast<double>(float_at(&bytes[at + 12 + 4 * k]));
    add_facet(mesh, corners, ++number);
  }
  return mesh;
}

RawMesh ascii_stl(const std::string& text, const std::string& file, Faults& faults) {
  RawMesh mesh;
  mesh.header = text.substr(0, text.find('\n'));
  std::istringstream words(text.substr(mesh.header.size()));
  FaultKind kind(faults, file, "facets");
  std::vector<Vec3> corners;
  std::uint32_t number = 1;
  bool ended = false;
  for (std::string word; words >> word;) {
    word = lower(word);
    if (word == "vertex") corners.push_back(next_point(words));
    if (word == "endsolid") ended = true;
    if (word != "endfacet") continue;
    if (corners.size() == 3)
      add_facet(mesh, {corners[0], corners[1], corners[2]}, number);
    else
      kind.add(FacetPlace{number}.text(), fmt::format("{} vertices", corners.size()), "must have three");
    corners.clear();
    ++number;
  }
  if (!ended) kind.add(FacetPlace{number}.text(), "", "is cut off: the file ends without 'endsolid'");
  return mesh;
}

/// Why bytes that are neither text nor as long as their header announces are refused.
void refuse_binary(const std::string& bytes, std::size_t announced, const std::string& file, Faults& faults) {
  const std::size_t needed = kHeader + 4 + announced * kRecord;
  const std::string rule = fmt::format("the header announces {} facets, {} bytes; the file has {}", announced,
                                       needed, bytes.size());
  if (bytes.size() > needed)
    faults.add(file, fmt::format("byte {}", needed + 1), "",
               fmt::format("{} bytes follow the last facet: {}", bytes.size() - needed, rule));
  else
    faults.add(file, fmt::format("facet {}", (bytes.size() - kHeader - 4) / kRecord + 1), "",
               "is cut off: " + rule);
}

}  // namespace

RawMesh parse_stl(const std::string& bytes, const std::string& file, Faults& faults) {
  const std::size_t announced = bytes.size() >= kHeader + 4 ? little_endian(&bytes[kHeader]) : 0;
  if (bytes.size() >= kHeader + 4 && bytes.size() == kHeader + 4 + announced * kRecord)
    return binary_stl(bytes);
  const std::string text = unix_lines(bytes);
  const std::size_t start = text.find_first_not_of(" \t\n");
  const bool solid = start != std::string::npos && lower(text.substr(start, 5)) == "solid";
  const std::size_t nul = bytes.find('\0');
  if (solid && nul == std::string::npos) return ascii_stl(text.substr(start), file, faults);
  if (solid && lower(bytes).find("endfacet") != std::string::npos)
    faults.add(file, fmt::format("byte {}", nul + 1), "", "is zero: the text of an ASCII file has none");
  else if (nul == std::string::npos || bytes.size() < kHeader + 4)
    faults.add(file, "", "",
               "is no STL file: neither 'solid …' nor a binary header with as many facets as it announces");
  else
    refuse_binary(bytes, announced, file, faults);
  return {};
}

}  // namespace repose
