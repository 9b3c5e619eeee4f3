#include "engine/shape/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "engine/shape/clump_export.hpp"
#include "engine/shape/mesh_check.hpp"
#include "engine/shape/mesh_formats.hpp"

namespace repose {

namespace {

constexpr double kSmallest = 1e-6;  ///< [m]
constexpr double kLargest = 5.0;    ///< [m]

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError({file.string(), "", "", "cannot be opened"});
  return {std::istreambuf_iterator<char>(stream), {}};
}

void check_numbers(const RawMesh& raw, const std::string& file, Faults& faults) {
  std::size_t found = 0;
  for (std::size_t f = 0; f < raw.facets.size(); ++f) {
    const bool finite = std::all_of(raw.facets[f].begin(), raw.facets[f].end(),
                                    [&](std::uint32_t corner) { return raw.vertices[corner].allFinite(); });
    if (!finite && ++found <= kNamedFaults)
      faults.add(file, fmt::format("facet {}", f + 1), "", "has a coordinate that is not a finite number");
  }
  if (found > kNamedFaults)
    faults.add(file, fmt::format("{} more facets", found - kNamedFaults), "",
               "have coordinates that are not finite");
}

double longest_side(const std::vector<Vec3>& vertices) {
  Vec3 low = vertices.front();
  Vec3 high = low;
  for (const Vec3& vertex : vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return (high - low).maxCoeff();
}

/// One vertex for all corners within the tolerance of it, found in the 27 cells around.
Mesh welded(const RawMesh& raw) {
  Mesh mesh;
  const double tolerance = std::max(1e-6 * longest_side(raw.vertices), 1e-300);
  using Cell = std::array<std::int64_t, 3>;
  std::map<Cell, std::vector<std::uint32_t>> cells;
  const auto cell_of = [&](const Vec3& p) {
    return Cell{std::llround(p.x() / tolerance), std::llround(p.y() / tolerance),
                std::llround(p.z() / tolerance)};
  };
  const auto vertex_near = [&](const Vec3& p) -> std::optional<std::uint32_t> {
    const Cell middle = cell_of(p);
    for (std::int64_t i = 0; i < 27; ++i) {
      const auto found =
          cells.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (found == cells.end()) continue;
      for (const std::uint32_t vertex : found->second)
        if ((mesh.vertices[vertex] - p).norm() <= tolerance) return vertex;
    }
    return std::nullopt;
  };
  std::vector<std::uint32_t> merged(raw.vertices.size());
  for (std::size_t i = 0; i < raw.vertices.size(); ++i) {
    if (const auto vertex = vertex_near(raw.vertices[i])) {
      merged[i] = *vertex;
      continue;
    }
    merged[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    cells[cell_of(raw.vertices[i])].push_back(merged[i]);
    mesh.vertices.push_back(raw.vertices[i]);
  }
  for (const auto& [a, b, c] : raw.facets) mesh.facets.push_back({merged[a], merged[b], merged[c]});
  return mesh;
}

/// The unit that a header names, as in "units=mm".
std::optional<double> named_unit(const std::string& header) {
  const std::string text = lower(header);
  for (const std::string key : {"units=", "unit=", "units:", "unit:"}) {
    const auto at = text.find(key);
    if (at == std::string::npos) continue;
    const auto start = text.find_first_not_of(' ', at + key.size());
    if (start == std::string::npos) continue;
    const auto end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz", start);
    return length_unit(text.substr(start, end - start));
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> length_unit(const std::string& name) {
  static const std::map<std::string, double> units = {
      {"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}};
  const auto found = units.find(name);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

Mesh read_mesh(const std::filesystem::path& path, std::optional<double> metres_per_unit) {
  const std::string file = path.string();
  const std::string bytes = content_of(path);
  const std::string extension = lower(path.extension().string());
  Faults faults;
  const RawMesh raw = extension == ".obj"   ? parse_obj(bytes, file, faults)
                      : extension == ".ply" ? parse_ply(bytes, file, faults)
                                            : parse_stl(bytes, file, faults);
  check_numbers(raw, file, faults);
  faults.throw_if_any();
  if (raw.facets.empty()) throw InputError({file, "", "", "holds no facets"});

  Mesh mesh = welded(raw);
  mesh.name = path.stem().string();
  faults = check_mesh(mesh, file);
  const double side = longest_side(mesh.vertices);
  const double unit =
      metres_per_unit ? *metres_per_unit : named_unit(raw.header).value_or(side > kLargest ? 1e-3 : 1.0);
  if (side * unit < kSmallest || side * unit > kLargest)
    faults.add(file, "", fmt::format("{:g} m", side * unit),
               "no particle has this size (1e-6 m to 5 m); is the unit of the file right?");
  faults.throw_if_any();
  for (Vec3& vertex : mesh.vertices) vertex *= unit;
  return mesh;
}

void write_stl(const std::filesystem::path& file, const Mesh& mesh) {
  std::string bytes = fmt::format("{}, units=mm", mesh.name.substr(0, 60));
  bytes.resize(80, ' ');
  const auto append = [&](const auto value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
  };
  append(static_cast<std::uint32_t>(mesh.facets.size()));
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& p = mesh.vertices[a];
    const Vec3 normal = (mesh.vertices[b] - p).cross(mesh.vertices[c] - p).normalized();
    for (const double value : normal) append(static_cast<float>(value));
    for (const std::uint32_t corner : {a, b, c})
      for (const double value : mesh.vertices[corner]) append(static_cast<float>(1000.0 * value));
    append(std::uint16_t{0});
  }
  write_text(file, bytes);
}

}  // namespace repose
