#include "engine/shape/clump_export.hpp"

#include <fmt/format.h>

#include <fstream>

#include "engine/base/input_error.hpp"

namespace repose {

namespace {

/// One line a sphere: x y z r with the separator, then the tail.
std::string sphere_lines(const Clump& clump, const std::string& separator, const std::string& tail) {
  std::string text;
  for (const Sphere& sphere : clump.spheres)
    text += fmt::format("{:.9e}{}{:.9e}{}{:.9e}{}{:.9e}{}\n", sphere.centre.x(), separator, sphere.centre.y(),
                        separator, sphere.centre.z(), separator, sphere.radius, tail);
  return text;
}

}  // namespace

std::string vtk_text(const Clump& clump) {
  const std::size_t count = clump.spheres.size();
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\nPOINTS {} double\n", clump.name, count);
  for (const Sphere& sphere : clump.spheres)
    text += fmt::format("{:.9e} {:.9e} {:.9e}\n", sphere.centre.x(), sphere.centre.y(), sphere.centre.z());
  text += fmt::format("VERTICES {} {}\n", count, 2 * count);
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("1 {}\n", i);
  text += fmt::format("POINT_DATA {}\nSCALARS radius double 1\nLOOKUP_TABLE default\n", count);
  for (const Sphere& sphere : clump.spheres) text += fmt::format("{:.9e}\n", sphere.radius);
  return text;
}

std::string liggghts_text(const Clump& clump, double density) {
  const Vec3 moments = density * clump.inertia;
  return fmt::format(
             "# {0}: x y z r [m], centre of mass at the origin, principal axes\n"
             "# fix ID all particletemplate/multisphere SEED atom_type 1 density constant {1:.9g} nspheres "
             "{2} ntry "
             "1000000 spheres file FILE type 1 mass {3:.9e} inertia_tensor {4:.9e} 0 0 {5:.9e} 0 {6:.9e} "
             "use_density\n",
             clump.name, density, clump.spheres.size(), density * clump.volume, moments.x(), moments.y(),
             moments.z()) +
         sphere_lines(clump, " ", "");
}

std::string yade_text(const Clump& clump) {
  return fmt::format("# {}: x y z r clumpId [m], for ymport.textClumps\n", clump.name) +
         sphere_lines(clump, " ", " 0");
}

void write_mercury(const std::filesystem::path& folder, const Clump& clump, double density) {
  const std::filesystem::path own = folder / clump.name;
  const Vec3 moments = density * clump.inertia;
  write_text(own / "Clump" / "Clump.txt", sphere_lines(clump, ",", ""));
  write_text(own / "Inertia" / "Mass.txt", fmt::format("{:.9e}\n", density * clump.volume));
  write_text(own / "Inertia" / "TOI.txt",
             fmt::format("{:.9e},0,0\n0,{:.9e},0\n0,0,{:.9e}\n", moments.x(), moments.y(), moments.z()));
  write_text(own / "Inertia" / "PD.txt", "1,0,0\n0,1,0\n0,0,1\n");
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::error_code ignored;  // a folder that cannot be made shows in the file that cannot be written
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw InputError({file.string(), "", "", "cannot be written"});
}

}  // namespace repose
