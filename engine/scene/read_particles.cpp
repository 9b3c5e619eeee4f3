#include <fmt/format.h>

#include <cmath>

#include "engine/scene/sections.hpp"
#include "engine/scene/units.hpp"
#include "engine/shape/length_unit.hpp"

namespace repose {

namespace {

constexpr const char* kShapes = "/particles/shapes";

/// The mean volume of the size classes by number: the size at which a sphere without a size of its own is
/// kept.
double mean_volume(const std::vector<SizeClass>& classes) {
  double volume = 0.0;
  for (const SizeClass& size : classes)
    volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  return volume;
}

std::optional<Clump> read_sphere(CheckedCase& checked, const std::string& pointer,
                                 const std::vector<SizeClass>& classes) {
  const std::string diameter = pointer + "/diameter_mm";
  if (checked.given(kClasses)) {
    if (checked.given(diameter)) {
      checked.fault(diameter, "excludes size_classes, which give the sizes: remove one of the two");
      return std::nullopt;
    }
    if (classes.empty()) return std::nullopt;
    return sphere_clump(std::cbrt(0.75 / kPi * mean_volume(classes)));
  }
  if (!checked.given(diameter)) {
    checked.fault(diameter, "is missing: a sphere needs it where there are no size_classes");
    return std::nullopt;
  }
  const std::optional<double> value = checked.number(diameter);
  if (!value) return std::nullopt;
  return sphere_clump(from_mm(*value) / 2.0);
}

/// The file that a key names, where it is there.
std::optional<std::filesystem::path> shape_file(CheckedCase& checked, const std::string& pointer) {
  const std::optional<std::string> name = checked.text(pointer);
  if (!name) return std::nullopt;
  const std::filesystem::path file = checked.document().resolve(pointer, *name);
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return file;
  checked.fault(pointer, "cannot be opened: " + file.string());
  return std::nullopt;
}

std::optional<Clump> read_clump_shape(CheckedCase& checked, const std::string& pointer, ShapeCache& shapes) {
  const auto file = shape_file(checked, pointer + "/clump");
  if (!file) return std::nullopt;
  return shapes.clump(*file);
}

std::optional<Clump> read_mesh_shape(CheckedCase& checked, const std::string& pointer, ShapeCache& shapes) {
  const std::string count = pointer + "/spheres";
  if (!checked.given(count)) checked.fault(count, "is missing: a mesh needs it");
  const std::optional<int> spheres = checked.integer(count);
  const auto file = shape_file(checked, pointer + "/mesh");
  const std::optional<std::string> name = checked.text(pointer + "/unit");
  const std::optional<LengthUnit> unit = name ? length_unit(*name) : std::nullopt;
  if (name && !unit) checked.fault(pointer + "/unit", "must be m, cm, mm, um or in");
  if (!spheres || !file || name.has_value() != unit.has_value()) return std::nullopt;
  return shapes.clump_of_mesh(*file, *spheres, unit ? std::optional(unit->metres) : std::nullopt);
}

/// A diameter sizes a sphere only: which of its sizes a clump's would be is open.
void refuse_diameters(CheckedCase& checked) {
  for (std::size_t i = 0; i < checked.entries(kClasses); ++i) {
    const std::string diameter = fmt::format("{}/{}/diameter_mm", kClasses, i);
    if (checked.given(diameter))
      checked.fault(diameter, "sizes spheres only: give volume_mm3 for other shapes");
  }
}

/// A key that belongs to another kind of shape.
void refuse_stray(CheckedCase& checked, const std::string& pointer, const char* key, const char* kind) {
  const std::string stray = fmt::format("{}/{}", pointer, key);
  if (checked.given(stray)) checked.fault(stray, fmt::format("goes with {} only", kind));
}

std::optional<Clump> read_shape(CheckedCase& checked, const std::string& pointer,
                                const std::vector<SizeClass>& classes, ShapeCache& shapes) {
  const bool sphere = checked.given(pointer + "/sphere");
  const bool clump = checked.given(pointer + "/clump");
  const bool mesh = checked.given(pointer + "/mesh");
  if (int{sphere} + int{clump} + int{mesh} != 1) {
    checked.fault(pointer, "must give one of sphere, clump or mesh");
    return std::nullopt;
  }
  if (!sphere) refuse_stray(checked, pointer, "diameter_mm", "sphere");
  if (!mesh) refuse_stray(checked, pointer, "spheres", "mesh");
  if (!mesh) refuse_stray(checked, pointer, "unit", "mesh");
  try {
    if (sphere) return read_sphere(checked, pointer, classes);
    if (clump) return read_clump_shape(checked, pointer, shapes);
    return read_mesh_shape(checked, pointer, shapes);
  } catch (const InputError& error) {
    checked.add(error);
    return std::nullopt;
  }
}

/// Every particle k times as large, and so 1/k³ as many; README.md says what that does to the laws.
void grow(Particles& particles, double k) {
  const double cube = k * k * k;
  for (SizeClass& size : particles.size_classes) size.volume_min *= cube, size.volume_max *= cube;
  for (Clump& shape : particles.shapes) {
    for (Sphere& sphere : shape.spheres) sphere.centre *= k, sphere.radius *= k;
    shape.volume *= cube;
    shape.inertia *= cube * k * k;
  }
}

}  // namespace

Material read_material(const CheckedCase& checked, const std::string& section) {
  return {.density = checked.number_or(section + "/density_kg_m3", 0.0),
          .shear_modulus = checked.number_or(section + "/shear_modulus_Pa", 0.0),
          .poisson_ratio = checked.number_or(section + "/poisson_ratio", 0.0)};
}

Particles read_particles(CheckedCase& checked, ShapeCache& shapes) {
  Particles particles;
  particles.material = read_material(checked, "/particles");
  particles.total_mass = checked.number_or("/particles/total_mass_kg", 0.0);
  particles.size_classes = read_size_classes(checked);
  const std::size_t count = checked.entries(kShapes);
  bool only_spheres = true;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string pointer = fmt::format("{}/{}", kShapes, i);
    if (!checked.is_sound(pointer)) continue;
    only_spheres = only_spheres && checked.given(pointer + "/sphere");
    if (auto clump = read_shape(checked, pointer, particles.size_classes, shapes))
      particles.shapes.push_back(*std::move(clump));
  }
  if (!only_spheres) refuse_diameters(checked);
  // Rules of the whole need the whole.
  if (particles.shapes.size() != count || (checked.given(kClasses) && particles.size_classes.empty()))
    particles.shapes.clear();
  if (const auto k = checked.number("/particles/coarse_graining")) grow(particles, *k);
  return particles;
}

}  // namespace repose
