#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "engine/scene/scene_reader.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"
#include "tools/program/stability_output.hpp"
#include "tools/program/verbs.hpp"
#include "tools/report/stability_charts.hpp"

namespace repose::program {

namespace {

struct StabilityOptions {
  CommonOptions common;
  std::string case_file;
  std::vector<std::string> assignments;
  std::string out;
  std::vector<double> scales{1.0, 0.1, 0.01};
  double precision = 0.05;
  double tolerance = Tolerance{}.energy;
  int bodies = 100;
  std::int64_t seed = 1;
  std::optional<int> threads;
};

Scene scene_to_map(const StabilityOptions& options, CaseDocument& document) {
  Faults faults;
  for (const std::string& assignment : options.assignments)
    document.set_from_command_line(assignment, faults);
  const Scene scene = read_scene(document, faults);
  check_folder(faults, options.out);
  for (const double scale : options.scales)
    check_range(faults, "--scales", scale, 1e-9, 1e9, "must be multiples of the case's stiffness, > 0");
  check_range(faults, "--precision", options.precision, 1e-3, 0.5, "must be between 0.001 and 0.5");
  check_range(faults, "--tolerance", options.tolerance, 1e-3, 1.0, "must be between 0.001 and 1");
  check_range(faults, "--bodies", options.bodies, 20, 100000, "must be between 20 and 100000");
  check_range(faults, "--seed", static_cast<double>(options.seed), 0, 9e18, "must be 0 or more");
  if (options.threads) check_threads(faults, *options.threads);
  faults.throw_if_any();
  return scene;
}

MapOptions map_options(const StabilityOptions& options) {
  MapOptions map;
  map.scales.clear();
  for (const double scale : options.scales)
    if (std::find(map.scales.begin(), map.scales.end(), scale) == map.scales.end())
      map.scales.push_back(scale);
  map.precision = options.precision;
  map.tolerance.energy = options.tolerance;
  map.bodies = options.bodies;
  map.seed = static_cast<std::uint64_t>(options.seed);
  map.threads = options.threads.value_or(0);
  return map;
}

/// The files of a map; those of an earlier one are replaced.
void write_map(const std::filesystem::path& folder, const StabilityMap& map, const Scene& scene,
               const MapOptions& options) {
  make_folder(folder);
  write_file(folder / "stability.csv", stability_csv(map));
  write_file(folder / "energy_error.csv", energy_error_csv(map));
  write_file(folder / "stability.json", to_json(map, scene).dump(2) + "\n");
  if (!map.interrupted) report::draw_stability(map, scene, options.tolerance, folder);
}

int stability(const StabilityOptions& options) {
  CaseDocument document = CaseDocument::load(options.case_file);
  const Scene scene = scene_to_map(options, document);
  make_folder(options.out);
  MapOptions map_with = map_options(options);
  ProgressLine line(options.common.quiet);
  const auto begin = std::chrono::steady_clock::now();
  map_with.stop = &watch_for_interrupt();
  map_with.on_progress = [&](int done, int all) {
    if (!line.due()) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    line.show_now(fmt::format("{} of {} experiments done, {}", done, all, duration_text(passed.count())));
  };
  const StabilityMap map = map_stability(scene, map_with);
  line.finish();
  write_map(options.out, map, scene, map_with);
  if (options.common.json) {
    print_json(to_json(map, scene));
  } else {
    fmt::print("{}written to {}\n", in_words(map, scene), options.out);
  }
  if (map.interrupted) return kInterrupted;
  return map.recommendation ? kDone : kNotCompleted;
}

}  // namespace

void add_stability(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "stability",
                           "The map of stable steps: the largest one of every integrator, rolling model and "
                           "stiffness in four experiments, and which step to choose",
                           stability, verb);
  verb->add_option("CASE", options.case_file, "The case, a JSON file")->required();
  verb->add_option("--out", options.out, "Folder for the tables, the charts and stability.json")->required();
  verb->add_option("--set", options.assignments, "KEY=VALUE …, as for simulate")->allow_extra_args(false);
  verb->add_option("--scales", options.scales,
                   "Multiples of the case's stiffness to map; 1 is always among them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  verb->add_option("--precision", options.precision,
                   "By which share the largest stable and the smallest unstable step may differ; smaller is "
                   "finer and takes longer")
      ->capture_default_str();
  verb->add_option("--tolerance", options.tolerance,
                   "Energy error up to which a step is stable, as a share of the experiment's energy")
      ->capture_default_str();
  verb->add_option("--bodies", options.bodies, "About as many in the column and the shortened slump")
      ->capture_default_str();
  verb->add_option("--seed", options.seed, "Of the poured particles")->capture_default_str();
  verb->add_option("--threads", options.threads, "Experiments at a time; default: one a core");
}

}  // namespace repose::program
