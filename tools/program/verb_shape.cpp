#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>

#include "engine/shape/mesh_file.hpp"
#include "engine/shape/scan_table.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/shape_pictures.hpp"
#include "tools/program/shape_verbs.hpp"

namespace repose::program {

namespace {

using Json = nlohmann::ordered_json;

struct ShapeOptions {
  CommonOptions common;
  std::string table;
  std::string plot;
  std::string meshes;
  std::optional<double> class_width;
  std::int64_t seed = 1;
};

/// A mesh that was made for a row.
struct MadeMesh {
  std::string name;
  std::filesystem::path file;
  double worst_error = 0.0;
};

/// A name of the table as JSON: a number where it is a whole one as it would be printed, so that no two names
/// become one.
Json name_json(const std::string& name) {
  long number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size() && fmt::format("{}", number) == name)
    return number;
  return name;
}

Json shape_json(const ScanTable& table, const std::vector<MadeMesh>& meshes) {
  Json json = {{"slope", table.slope},
               {"intercept_mm2", table.intercept_mm2},
               {"r_squared", table.r_squared},
               {"adjusted_r_squared", table.adjusted_r_squared},
               {"mean_sphericity", table.mean_sphericity},
               {"mean_recomputed_sphericity", table.mean_recomputed_sphericity}};
  json["size_classes"] = Json::array();
  for (const SizeHistogramClass& size : table.size_classes)
    json["size_classes"].push_back({{"volume_mm3", {size.volume_min_mm3, size.volume_max_mm3}},
                                    {"count", size.count},
                                    {"percent", size.percent}});
  json["inconsistent_rows"] = Json::array();
  for (const InconsistentValue& value : table.inconsistent)
    json["inconsistent_rows"].push_back({{"no", name_json(value.name)},
                                         {"line", value.line},
                                         {"column", value.column},
                                         {"printed", value.printed},
                                         {"recomputed", value.recomputed},
                                         {"within_rounding_of_volume", value.within_rounding}});
  json["pi_of_equivalent_sphere_area"] = table.pi_of_table;
  json["particles"] = Json::array();
  for (const ScannedParticle& particle : table.particles)
    json["particles"].push_back({{"no", name_json(particle.name)},
                                 {"sphericity", particle.sphericity},
                                 {"equivalent_sphere_area_mm2", particle.equivalent_area_mm2}});
  if (!meshes.empty()) json["meshes"] = Json::array();
  for (const MadeMesh& mesh : meshes)
    json["meshes"].push_back(
        {{"no", name_json(mesh.name)}, {"file", mesh.file.string()}, {"worst_error", mesh.worst_error}});
  return json;
}

void print_words(const ScanTable& table, const std::vector<MadeMesh>& meshes) {
  fmt::print("{} particles, mean sphericity {:.3f} (recomputed {:.4f})\n", table.particles.size(),
             table.mean_sphericity, table.mean_recomputed_sphericity);
  fmt::print("equivalent surface = {:.4f} x surface {:+.3f} mm2   R2 {:.4f}, adjusted {:.4f}\n\n",
             table.slope, table.intercept_mm2, table.r_squared, table.adjusted_r_squared);
  fmt::print("{:>8} {:>11} {:>11} {:>11}\n", "no", "V mm3", "SA mm2", "sphericity");
  for (const ScannedParticle& particle : table.particles)
    fmt::print("{:>8} {:>11.2f} {:>11.2f} {:>11.3f}\n", particle.name, particle.volume_mm3.value,
               particle.area_mm2, particle.sphericity);
  fmt::print("\n{:>19} {:>7} {:>9}\n", "volume mm3", "number", "percent");
  for (const SizeHistogramClass& size : table.size_classes)
    fmt::print("{:>8g} - {:>8g} {:>7} {:>9.2f}\n", size.volume_min_mm3, size.volume_max_mm3, size.count,
               size.percent);
  if (table.pi_of_table != kPi)
    fmt::print("\nThe column equivalent_sphere_area_mm2 was computed with pi = {:g}.\n", table.pi_of_table);
  if (!table.inconsistent.empty())
    fmt::print("\nPrinted values that the row's volume and surface do not give:\n");
  for (const InconsistentValue& value : table.inconsistent)
    fmt::print("  no. {} (line {}): {} {:g}, recomputed {:.6g}{}\n", value.name, value.line, value.column,
               value.printed, value.recomputed,
               value.within_rounding ? "; the rounding of the volume can explain it" : "");
  for (const MadeMesh& mesh : meshes) fmt::print("{}\n", mesh.file.string());
}

/// A file name for a particle: what could lead to another folder or trouble a shell becomes '_'.
std::string file_name(const std::string& particle) {
  std::string name = "particle_" + particle;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
  return name;
}

std::filesystem::path mesh_file(const ScannedParticle& particle, const ShapeOptions& options) {
  return std::filesystem::path(options.meshes) / (file_name(particle.name) + ".stl");
}

/// What of a table no meshes can be written for: no extents, names that become one file.
void check_files(const ScanTable& table, const ShapeOptions& options, Faults& faults) {
  if (!table.particles.front().extents_mm)
    faults.add(table.file, "", "", "a mesh needs the columns x_mm, y_mm and z_mm");
  std::map<std::string, const ScannedParticle*> owners;
  for (const ScannedParticle& particle : table.particles) {
    const auto [owner, is_new] = owners.emplace(file_name(particle.name), &particle);
    if (!is_new)
      faults.add(
          table.file, fmt::format("line {}", particle.line), particle.name,
          fmt::format("its mesh would be {}, like that of '{}' in line {}: rename one",
                      mesh_file(particle, options).string(), owner->second->name, owner->second->line));
  }
}

/// A mesh for every row, none of them written. Throws InputError with every row that has none.
std::vector<Rock> make_rocks(const ScanTable& table, const ShapeOptions& options) {
  Faults faults;
  check_files(table, options, faults);
  std::vector<Rock> rocks;
  for (const ScannedParticle& particle : table.particles) {
    if (!particle.extents_mm) continue;
    try {
      rocks.push_back(
          make_rock(figures_of(particle),
                    {.seed = static_cast<std::uint64_t>(options.seed), .name = file_name(particle.name)},
                    table.file, fmt::format("line {}", particle.line)));
    } catch (const InputError& error) {
      faults.add(error);
    }
  }
  faults.throw_if_any();
  return rocks;
}

std::vector<MadeMesh> write_meshes(const ScanTable& table, const std::vector<Rock>& rocks,
                                   const ShapeOptions& options) {
  std::vector<MadeMesh> made;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    made.push_back({table.particles[i].name, mesh_file(table.particles[i], options), rocks[i].worst_error});
    write_stl(made.back().file, rocks[i].mesh);
    if (!options.common.quiet) fmt::print(stderr, "{}\n", made.back().file.string());
  }
  return made;
}

/// The table; the faults of the command line and of the table together.
ScanTable checked_table(const ShapeOptions& options) {
  Faults faults;
  if (options.class_width)
    check_range(faults, "--class-width", *options.class_width, 1e-6, 1e12,
                "must be a width from 1e-6 to 1e12 mm3");
  check_range(faults, "--seed", static_cast<double>(options.seed), 0, 9.3e18, "must be 0 or more");
  if (!options.plot.empty()) check_output_file(faults, options.plot);
  if (!options.meshes.empty()) check_folder(faults, options.meshes);
  ScanTable table;
  try {
    const bool usable = options.class_width && *options.class_width > 0.0;
    table = read_scan_table(options.table, {.class_width_mm3 = usable ? options.class_width : std::nullopt});
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  return table;
}

int shape_verb(const ShapeOptions& options) {
  const ScanTable table = checked_table(options);
  std::vector<Rock> rocks;
  if (!options.meshes.empty()) rocks = make_rocks(table, options);
  if (!options.plot.empty()) draw_sphericity(options.plot, table);
  const std::vector<MadeMesh> meshes = write_meshes(table, rocks, options);
  if (options.common.json)
    print_json(shape_json(table, meshes));
  else
    print_words(table, meshes);
  return kDone;
}

}  // namespace

void add_shape(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options =
      add_verb(app, chosen, "shape",
               "Sphericity and sizes of a table of scanned particles, and meshes for them", shape_verb, verb);
  verb->add_option("TABLE", options.table,
                   "CSV with the columns surface_area_mm2, volume_mm3 and, for meshes, x_mm, y_mm, z_mm")
      ->required();
  verb->add_option("--plot", options.plot, "Draw equivalent surface against surface into this PNG");
  verb->add_option(
      "--meshes", options.meshes,
      "Make a closed body with its row's extents, volume and surface for every row, as STL in this folder");
  verb->add_option("--class-width", options.class_width, "Width of the size classes in mm3");
  verb->add_option("--seed", options.seed, "Seed of the meshes")->capture_default_str();
}

}  // namespace repose::program
