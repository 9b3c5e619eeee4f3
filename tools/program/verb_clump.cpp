#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <optional>

#include "engine/base/csv.hpp"
#include "engine/shape/clump_export.hpp"
#include "engine/shape/clump_generator.hpp"
#include "engine/shape/length_unit.hpp"
#include "engine/shape/mesh_file.hpp"
#include "tools/program/clump_words.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/shape_pictures.hpp"
#include "tools/program/shape_verbs.hpp"

namespace repose::program {

namespace {

using Json = nlohmann::ordered_json;

struct ClumpVerbOptions {
  CommonOptions common;
  std::vector<std::string> meshes;
  std::vector<int> spheres;
  std::string volume_error, eit_error, surface_error;
  double min_radius_mm = 0.0;
  int max_spheres = 200;
  double density = 1.0;
  std::string unit = "auto";
  std::int64_t seed = 1;
  std::string out, vtk, liggghts, yade, mercury, picture, study;
};

/// "0.013" or "1.3%" as 0.013.
std::optional<double> error_bound(const std::string& name, std::string text, Faults& faults) {
  if (text.empty()) return std::nullopt;
  const std::string given = text;
  const bool percent = text.back() == '%';
  if (percent) text.pop_back();
  const auto number = parse_number(text);
  const double value = number.value_or(0.0) * (percent ? 0.01 : 1.0);
  if (!(value > 0.0 && value < 1.0))
    faults.add(name, "", given, "must be a fraction between 0 and 1, or a percentage such as 1.3%");
  return value;
}

ClumpOptions generator_options(const ClumpVerbOptions& options, Faults& faults) {
  ClumpOptions result;
  if (!options.spheres.empty()) result.spheres = options.spheres.front();
  result.volume_error = error_bound("--volume-error", options.volume_error, faults);
  result.eit_error = error_bound("--eit-error", options.eit_error, faults);
  result.surface_error = error_bound("--surface-error", options.surface_error, faults);
  result.min_radius = 1e-3 * options.min_radius_mm;
  check_range(faults, "--seed", static_cast<double>(options.seed), 0, 9.3e18, "must be 0 or more");
  result.seed = static_cast<std::uint64_t>(options.seed);
  result.max_spheres = options.max_spheres;
  const bool bounded = result.volume_error || result.eit_error || result.surface_error;
  if (bounded != options.spheres.empty())
    faults.add("--spheres", "", "",
               "give either --spheres or one of --volume-error, --eit-error, --surface-error");
  for (const int count : options.spheres)
    check_range(faults, "--spheres", count, 1, kMostSpheres, fmt::format("must be 1 to {}", kMostSpheres));
  check_range(faults, "--max-spheres", options.max_spheres, 1, kMostSpheres,
              fmt::format("must be 1 to {}", kMostSpheres));
  check_range(faults, "--density", options.density, 1e-9, 1e9, "must be > 0");
  check_range(faults, "--min-radius", options.min_radius_mm, 0.0, 1e6, "must be a radius in mm, 0 or more");
  return result;
}

/// A mesh of the command line, read.
struct Source {
  std::string file;
  MeshFromFile read;
};

std::vector<Source> read_meshes(const ClumpVerbOptions& options, Faults& faults) {
  const auto unit = length_unit(options.unit);
  std::vector<Source> sources;
  for (const std::string& file : options.meshes) {
    try {
      sources.push_back({file, read_mesh_file(file, unit ? std::optional(unit->metres) : std::nullopt)});
    } catch (const InputError& error) {
      faults.add(error);
      continue;
    }
    const double half = 0.5e3 * measure(sources.back().read.mesh).equivalent_diameter();
    if (options.min_radius_mm >= half)
      faults.add("--min-radius", "", fmt::format("{:g} mm", options.min_radius_mm),
                 fmt::format("must be below half the equivalent diameter of {}, {:g} mm", file, half));
  }
  return sources;
}

/// Meshes of one name, whose clumps would be written over one another.
void check_names(const std::vector<std::string>& files, Faults& faults) {
  std::map<std::string, std::string> owners;
  for (const std::string& file : files) {
    const auto [owner, is_new] = owners.emplace(std::filesystem::path(file).stem().string(), file);
    if (!is_new)
      faults.add(
          file, "", "",
          fmt::format("has the name of {}, so that the clumps of one would be written over those of the "
                      "other",
                      owner->second));
  }
}

/// Files and folders that are to be written.
void check_outputs(const ClumpVerbOptions& options, Faults& faults) {
  const std::vector<std::pair<const char*, std::string>> single = {{"--out", options.out},
                                                                   {"--vtk", options.vtk},
                                                                   {"--liggghts", options.liggghts},
                                                                   {"--yade", options.yade},
                                                                   {"--mercury", options.mercury}};
  if (!options.study.empty()) {
    check_folder(faults, options.study);
    for (const auto& [option, file] : single)
      if (!file.empty())
        faults.add(option, "", file, "goes with a single clump only: --study writes clumps into its folder");
    check_names(options.meshes, faults);
    return;
  }
  for (const std::string& file : {options.out, options.vtk, options.liggghts, options.yade, options.picture})
    if (!file.empty()) check_output_file(faults, file);
  if (!options.mercury.empty()) check_folder(faults, options.mercury);
}

void write_clump_to(const std::filesystem::path& file, const GeneratedClump& made,
                    const ClumpVerbOptions& options) {
  write_clump(file, made.clump,
              {.density = options.density,
               .inner = made.inner,
               .made_by = fmt::format("repose clump, seed {}", options.seed),
               .volume_error = made.errors.volume_error,
               .eit_error = made.errors.eit_error});
}

/// generate_clump(); its faults name the file.
GeneratedClump clump_of(const Source& source, const ClumpOptions& options) {
  try {
    return generate_clump(source.read.mesh, options);
  } catch (const InputError& error) {
    throw error.in_file(source.file);
  }
}

void require_met(const GeneratedClump& made, const std::string& file, const ClumpOptions& options) {
  if (made.met) return;
  throw InputError(
      {file, "", "",
       fmt::format(
           "no clump of up to {} spheres meets the bounds; with {} the errors are: volume {:.4f} %, EIT "
           "{:.4f} %, surface {:.2f} %",
           options.max_spheres, options.max_spheres, 100 * made.errors.volume_error,
           100 * made.errors.eit_error, 100 * made.errors.mean_distance)});
}

int one_clump(const ClumpVerbOptions& options, const ClumpOptions& wanted, const Source& source) {
  const Mesh& mesh = source.read.mesh;
  const GeneratedClump made = clump_of(source, wanted);
  require_met(made, source.file, wanted);
  if (!options.out.empty()) write_clump_to(options.out, made, options);
  if (!options.vtk.empty()) write_text(options.vtk, vtk_text(made.clump));
  if (!options.liggghts.empty()) write_text(options.liggghts, liggghts_text(made.clump, options.density));
  if (!options.yade.empty()) write_text(options.yade, yade_text(made.clump));
  if (!options.mercury.empty()) write_mercury(options.mercury, made.clump, options.density);
  if (!options.picture.empty()) draw_clumps(options.picture, mesh, {made.clump});
  if (options.common.json)
    print_json(clump_json(made, options.density, source.read));
  else
    fmt::print("{}", clump_in_words(made, source.read));
  return kDone;
}

/// Every mesh with every number of spheres: clumps, a table of errors, and per mesh the pictures of both.
/// Clumps that cannot be made are named in the end, when the others are written.
int study(const ClumpVerbOptions& options, const ClumpOptions& wanted, const std::vector<Source>& sources) {
  const std::filesystem::path folder = options.study;
  std::string table =
      "mesh,spheres,volume_error_percent,eit_error_percent,mean_distance_percent,max_distance_percent,"
      "sphericity,"
      "mesh_sphericity,smallest_radius_mm,cpu_s\n";
  Json rows = Json::array();
  Faults refused;
  for (const Source& source : sources) {
    const Mesh& mesh = source.read.mesh;
    std::vector<Clump> clumps;
    std::vector<ErrorPoint> points;
    for (const int count : options.spheres) {
      ClumpOptions own = wanted;
      own.spheres = count;
      const std::clock_t start = std::clock();
      GeneratedClump made;
      try {
        made = clump_of(source, own);
      } catch (const InputError& error) {
        refused.add(error);
        continue;
      }
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      write_clump_to(folder / fmt::format("{}_{}.json", mesh.name, count), made, options);
      const std::string row =
          fmt::format("{},{},{:.5f},{:.5f},{:.3f},{:.2f},{:.4f},{:.4f},{:.4f},{:.2f}\n", mesh.name, count,
                      100 * made.errors.volume_error, 100 * made.errors.eit_error,
                      100 * made.errors.mean_distance, 100 * made.errors.max_distance, made.errors.sphericity,
                      measure(mesh).sphericity(), 1e3 * made.clump.smallest_radius(), seconds);
      if (!options.common.quiet) fmt::print(stderr, "{}", row);
      table += row;
      Json entry = {{"mesh", mesh.name}, {"spheres", count}};
      entry.update(errors_json(made));
      rows.push_back(entry);
      clumps.push_back(made.clump);
      points.push_back({count, made.errors.volume_error, made.errors.eit_error, made.errors.mean_distance});
    }
    if (!options.picture.empty() && !clumps.empty()) {
      draw_clumps(folder / (mesh.name + "_clumps.png"), mesh, clumps);
      draw_errors(folder / (mesh.name + "_errors.png"), mesh.name, points);
    }
  }
  write_text(folder / "errors.csv", table);
  refused.throw_if_any();
  if (options.common.json)
    print_json({{"errors", rows}});
  else
    fmt::print("{}", table);
  return kDone;
}

int clump_verb(const ClumpVerbOptions& options) {
  Faults faults;
  const ClumpOptions wanted = generator_options(options, faults);
  const bool several = options.meshes.size() > 1 || options.spheres.size() > 1;
  if (!options.study.empty() && options.spheres.empty())
    faults.add("--study", "", "", "needs --spheres, e.g. 5,10,20,30,60");
  if (options.study.empty() && several)
    faults.add("--study", "", "",
               "several meshes or numbers of spheres need --study for the folder to write to");
  check_outputs(options, faults);
  const std::vector<Source> sources = read_meshes(options, faults);
  faults.throw_if_any();
  return options.study.empty() ? one_clump(options, wanted, sources.front())
                               : study(options, wanted, sources);
}

}  // namespace

void add_clump(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options =
      add_verb(app, chosen, "clump", "A clump of spheres for a mesh, with its errors", clump_verb, verb);
  verb->add_option("MESH", options.meshes, "STL, OBJ or ASCII PLY of one closed body")->required();
  verb->add_option("--spheres", options.spheres, "Number of spheres (with --study several: 5,10,20)")
      ->delimiter(',');
  verb->add_option("--volume-error", options.volume_error,
                   "Fewest spheres whose union has the mesh's volume within this: 0.013 or 1.3%");
  verb->add_option("--eit-error", options.eit_error,
                   "The same for the mean error of the principal moments of inertia");
  verb->add_option("--surface-error", options.surface_error,
                   "The same for the mean distance of the surfaces over the equivalent diameter");
  verb->add_option("--max-spheres", options.max_spheres, "Where the search for the fewest gives up")
      ->capture_default_str();
  verb->add_option("--min-radius", options.min_radius_mm, "No sphere smaller than this, in mm");
  verb->add_option("--density", options.density, "kg/m3 that mass and inertia are given for")
      ->capture_default_str();
  verb->add_option("--unit", options.unit,
                   "Unit of the mesh; auto: as the file says, else m, mm for more than 5 m")
      ->check(CLI::IsMember({"auto", "m", "cm", "mm", "um", "in"}))
      ->capture_default_str();
  verb->add_option("--seed", options.seed, "Another seed gives another, equally valid clump")
      ->capture_default_str();
  verb->add_option("--out", options.out, "Clump file to write");
  verb->add_option("--vtk", options.vtk, "The spheres for ParaView");
  verb->add_option("--liggghts", options.liggghts, "Multisphere template for LIGGGHTS");
  verb->add_option("--yade", options.yade, "Clump for YADE's ymport.textClumps");
  verb->add_option("--mercury", options.mercury, "Folder for a clump in the layout of MercuryDPM's MClump");
  verb->add_option("--picture", options.picture,
                   "PNG of the mesh beside the clump; with --study any word: one a mesh");
  verb->add_option("--study", options.study,
                   "Folder for clumps and errors of every MESH with every number of spheres");
}

}  // namespace repose::program
