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
#include "engine/shape/length_unit.hpp"
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
  FaultKind kind(faults, file, "facets");
  std::uint32_t named = 0;
  for (std::size_t f = 0; f < raw.facets.size(); ++f) {
    if (raw.places[f].number == named) continue;  // a face of several triangles is named once
    const bool finite = std::all_of(raw.facets[f].begin(), raw.facets[f].end(),
                                    [&](std::uint32_t corner) { return raw.vertices[corner].allFinite(); });
    if (finite) continue;
    kind.add(raw.places[f].text(), "", "has a coordinate that is not a finite number");
    named = raw.places[f].number;
  }
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

}  // namespace

MeshFromFile read_mesh_file(const std::filesystem::path& path, std::optional<double> metres_per_unit) {
  const std::string file = path.string();
  const std::string bytes = content_of(path);
  const std::string extension = lower(path.extension().string());
  Faults faults;
  const RawMesh raw = extension == ".obj"   ? parse_obj(bytes, file, faults)
                      : extension == ".ply" ? parse_ply(bytes, file, faults)
                                            : parse_stl(bytes, file, faults);
  check_numbers(raw, file, faults);
  // A unit that is given makes what the file says of it irrelevant, mistakes as well.
  const auto named = metres_per_unit ? std::nullopt : named_unit(raw.header, file, faults);
  faults.throw_if_any();
  if (raw.facets.empty()) throw InputError({file, "", "", "holds no facets"});

  MeshFromFile read{.mesh = welded(raw)};
  read.mesh.name = path.stem().string();
  faults = check_mesh(read.mesh, file, [&](std::size_t facet) { return raw.places[facet].text(); });
  const double side = longest_side(read.mesh.vertices);
  read.unit_source = metres_per_unit ? UnitSource::given : named ? UnitSource::file : UnitSource::size;
  read.metres_per_unit = metres_per_unit   ? *metres_per_unit
                         : named           ? named->metres
                         : side > kLargest ? 1e-3
                                           : 1.0;
  const double unit = read.metres_per_unit;
  if (side * unit < kSmallest || side * unit > kLargest)
    faults.add(file, "", fmt::format("{:g} m", side * unit),
               "no particle has this size (1e-6 m to 5 m); is the unit of the file right?");
  faults.throw_if_any();
  for (Vec3& vertex : read.mesh.vertices) vertex *= unit;
  return read;
}

Mesh read_mesh(const std::filesystem::path& file, std::optional<double> metres_per_unit) {
  return read_mesh_file(file, metres_per_unit).mesh;
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
