#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/shape/mesh.hpp"

namespace repose {

/// Reads a mesh and checks that it is a body (mesh_check.hpp). By extension: .obj and .ply (ASCII);
/// everything else is STL, binary or ASCII, told apart by its length. Faces of more than three corners are
/// cut into fans. Corners closer than 1e-6 of the size are one corner.
///
/// Unit: `metres_per_unit` if given; otherwise the file's own ("units=mm" in an STL header or a comment, as
/// write_stl() writes it; named_unit()); otherwise metres, unless the body would be longer than 5 m: then
/// millimetres, since no particle is that large. Throws InputError with every fault: cannot be opened, is not
/// what it should be, ends early, numbers that are not finite (with their facet), a unit that is not known,
/// whatever check_mesh() finds, a size outside 1 µm … 5 m.
Mesh read_mesh(const std::filesystem::path& file, std::optional<double> metres_per_unit = std::nullopt);

/// Who says what the unit of a mesh is.
enum class UnitSource { given, file, size };

/// A mesh in metres and what its file was taken to be in.
struct MeshFromFile {
  Mesh mesh;
  double metres_per_unit = 1.0;
  UnitSource unit_source = UnitSource::size;
};

/// read_mesh() with the unit.
MeshFromFile read_mesh_file(const std::filesystem::path& file,
                            std::optional<double> metres_per_unit = std::nullopt);

/// Writes binary STL in millimetres, saying so in its header. Throws InputError where the file cannot be
/// written.
void write_stl(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace repose
