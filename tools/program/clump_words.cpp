#include "tools/program/clump_words.hpp"

#include <fmt/format.h>

#include "engine/shape/length_unit.hpp"

namespace repose::program {

using Json = nlohmann::ordered_json;

namespace {

/// The unit of a mesh in words: "mm, as the file says".
std::string unit_in_words(const MeshFromFile& read) {
  const char* source = read.unit_source == UnitSource::given  ? "as --unit says"
                       : read.unit_source == UnitSource::file ? "as the file says"
                                                              : "guessed by the size: the file names none";
  return fmt::format("{}, {}", unit_name(read.metres_per_unit), source);
}

Json unit_json(const MeshFromFile& read) {
  const char* source = read.unit_source == UnitSource::given  ? "option"
                       : read.unit_source == UnitSource::file ? "file"
                                                              : "size";
  return {{"name", unit_name(read.metres_per_unit)}, {"from", source}};
}

}  // namespace

Json errors_json(const GeneratedClump& made) {
  const ClumpErrors& errors = made.errors;
  return {{"volume_error", errors.volume_error},
          {"eit_error", errors.eit_error},
          {"computation_error", errors.computation_error},
          {"centre_offset", errors.centre_offset},
          {"mean_surface_distance", errors.mean_distance},
          {"max_surface_distance", errors.max_distance},
          {"sphericity", errors.sphericity}};
}

Json clump_json(const GeneratedClump& made, double density, const MeshFromFile& source) {
  Json json;
  json["spheres"] = Json::array();
  const auto add = [&](const Sphere& sphere, bool inner) {
    Json item = {
        {"x", sphere.centre.x()}, {"y", sphere.centre.y()}, {"z", sphere.centre.z()}, {"r", sphere.radius}};
    if (inner) item["inner"] = true;
    json["spheres"].push_back(item);
  };
  for (const Sphere& sphere : made.clump.spheres) add(sphere, false);
  for (const Sphere& sphere : made.inner) add(sphere, true);
  json.update(errors_json(made));
  const Vec3 moments = density * made.clump.inertia;
  const Vec3 extents = measure(source.mesh).extents;
  json["density_kg_m3"] = density;
  json["mass"] = density * made.clump.volume;
  json["inertia"] = {moments.x(), moments.y(), moments.z()};
  json["groups_of_spheres"] = made.clump.groups();
  json["smallest_radius_m"] = made.clump.smallest_radius();
  json["equivalent_diameter_m"] = made.clump.equivalent_diameter();
  json["mesh_extents_m"] = {extents.x(), extents.y(), extents.z()};
  json["mesh_unit"] = unit_json(source);
  return json;
}

std::string clump_in_words(const GeneratedClump& made, const MeshFromFile& source) {
  const ClumpErrors& errors = made.errors;
  const Mesh& mesh = source.mesh;
  const MeshMeasures body = measure(mesh);
  const Vec3 extents = 1e3 * body.extents;
  return fmt::format(
             "mesh    {}: {:.4g} x {:.4g} x {:.4g} mm, volume {:.5g} mm3, sphericity {:.3f}\n"
             "unit    {}\n"
             "clump   {} spheres ({} that nothing can touch), smallest radius {:.4g} mm, sphericity {:.3f}\n"
             "errors  volume {:.4f} %, EIT {:.4f} % (integration within {:.1e} %)\n"
             "surface {:.2f} % of the equivalent diameter away on the average, {:.1f} % at most\n",
             mesh.name, extents.x(), extents.y(), extents.z(), 1e9 * body.volume, body.sphericity(),
             unit_in_words(source), made.clump.spheres.size() + made.inner.size(), made.inner.size(),
             1e3 * made.clump.smallest_radius(), errors.sphericity, 100 * errors.volume_error,
             100 * errors.eit_error, 100 * errors.computation_error, 100 * errors.mean_distance,
             100 * errors.max_distance) +
         (made.clump.groups() > 1
              ? fmt::format(
                    "gaps    its spheres fall into {} groups that do not touch: give it more spheres\n",
                    made.clump.groups())
              : "");
}

}  // namespace repose::program
