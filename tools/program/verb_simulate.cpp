#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "engine/run/run.hpp"
#include "engine/scene/scene_reader.hpp"
#include "tools/program/frame_writer.hpp"
#include "tools/program/heap_files.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"
#include "tools/program/result_json.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace {

struct SimulateOptions {
  CommonOptions common;
  std::string case_file;
  std::vector<std::string> assignments;
  std::optional<std::int64_t> seed;
  std::string out;
  int frames = 0;
  int threads = 1;
};

constexpr int kMostFrames = 10000;

/// The case with what was set on the command line, and the faults of everything that was asked for.
Scene checked_scene(const SimulateOptions& options, CaseDocument& document) {
  Faults faults;
  for (const std::string& assignment : options.assignments)
    document.set_from_command_line(assignment, faults);
  const Scene scene = read_scene(document, faults);
  if (!options.out.empty()) check_folder(faults, options.out);
  check_range(faults, "--frames", options.frames, 0, kMostFrames,
              fmt::format("must be between 0 and {}", kMostFrames));
  check_range(faults, "--threads", options.threads, 1, Crew::kMostMembers,
              fmt::format("must be between 1 and {}", Crew::kMostMembers));
  if (options.seed && *options.seed < 0)
    faults.add("--seed", "", std::to_string(*options.seed), "must be 0 or more");
  if (options.frames > 0 && options.out.empty())
    faults.add("--frames", "", std::to_string(options.frames), "needs --out for the folder to write to");
  faults.throw_if_any();
  return scene;
}

/// Without --seed: the seed of the case's sweep where it has one, otherwise 1.
std::uint64_t seed_for(const SimulateOptions& options, const CaseDocument& document) {
  if (options.seed) return static_cast<std::uint64_t>(*options.seed);
  const auto* seed = document.find("/sweep/seed");
  return seed != nullptr && seed->is_number_unsigned() ? seed->get<std::uint64_t>() : 1;
}

std::string text_of(const Progress& progress) {
  std::string text =
      fmt::format("{:<6} {:7.3f} s   {} particles", progress.stage, progress.time, progress.bodies);
  if (progress.expected_mass_share < 1.0)
    text += fmt::format(", {:.0f} % poured", 100.0 * progress.expected_mass_share);
  return text + fmt::format("   kinetic energy {:.1e} m g d", progress.energy_ratio);
}

int exit_code_of_outcome(Outcome outcome) {
  if (outcome == Outcome::completed) return kDone;
  return outcome == Outcome::interrupted ? kInterrupted : kNotCompleted;
}

int simulate(const SimulateOptions& options) {
  CaseDocument document = CaseDocument::load(options.case_file);
  const Scene scene = checked_scene(options, document);
  const std::filesystem::path folder = options.out;
  if (!options.out.empty()) make_folder(folder);

  ProgressLine line(options.common.quiet);
  RunOptions run;
  run.crew = std::make_shared<Crew>(options.threads - 1);
  run.stop = &watch_for_interrupt();
  run.on_progress = [&](const Progress& progress) {
    if (line.due()) line.show_now(text_of(progress));
  };
  std::optional<FrameWriter> frames;
  if (options.frames > 0) {
    frames.emplace(folder, scene, options.frames);
    run.frame_interval = frames->interval();
    run.on_frame = [&](const HeapSnapshot& heap) { frames->add(heap); };
  }

  const RunResult result = run_slump_test(scene, seed_for(options, document), run);
  line.finish();
  if (frames) frames->finish(result.heap);
  const auto json = to_json(result, scene.title);
  if (!options.out.empty()) write_heap_files(folder, result, scene.title, json);
  if (options.common.json) {
    print_json(json);
  } else {
    fmt::print("{}", in_words(result));
    if (!options.out.empty()) fmt::print("written to {}\n", folder.string());
  }
  return exit_code_of_outcome(result.outcome);
}

}  // namespace

void add_simulate(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options =
      add_verb(app, chosen, "simulate", "One slump test: its angle, its responses, its heap", simulate, verb);
  verb->add_option("CASE", options.case_file, "The case, a JSON file")->required();
  verb->add_option("--set", options.assignments,
                   "KEY=VALUE …: a factor (mu_s=0.4) or a JSON pointer into the case "
                   "(/numerics/time_step_fraction=0.2)");
  verb->add_option("--seed", options.seed, "Of the random numbers; default: the case's /sweep/seed, or 1");
  verb->add_option("--out", options.out,
                   "Folder for the result, the heap (VTK, dump) and the profile picture");
  verb->add_option("--threads", options.threads,
                   "That share the work of the test; default: 1. The result is the same");
  verb->add_option("--frames", options.frames, "Write this many instants of the test for ParaView, in --out");
}

}  // namespace repose::program
