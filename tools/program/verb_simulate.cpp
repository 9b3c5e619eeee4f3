#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "engine/base/csv.hpp"
#include "engine/base/json_file.hpp"
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
  std::string seed;  ///< "": not given
  std::string out;
  int frames = 0;
  int threads = 1;
};

constexpr int kMostFrames = 10000;

/// Without --seed: the seed of the case's sweep where it has one, otherwise 1.
std::uint64_t seed_for(const SimulateOptions& options, const CaseDocument& document, Faults& faults) {
  constexpr const char* kRule = "must be an integer from 0 to 9007199254740991";
  const auto checked = [&](std::optional<double> value, const Fault& fault) -> std::uint64_t {
    if (value && *value >= 0.0 && *value < 0x1p53 && *value == std::floor(*value))
      return static_cast<std::uint64_t>(*value);
    faults.add(fault.file, fault.pointer, fault.value, fault.rule);
    return 1;
  };
  if (!options.seed.empty()) return checked(parse_number(options.seed), {"--seed", "", options.seed, kRule});
  constexpr const char* kPlace = "/sweep/seed";
  const auto* seed = document.find(kPlace);
  if (seed == nullptr) return 1;
  return checked(seed->is_number() ? std::optional(seed->get<double>()) : std::nullopt,
                 {document.source(kPlace), kPlace, shown(*seed), kRule});
}

struct CheckedTest {
  Scene scene;
  std::uint64_t seed = 1;
};

/// The case with what was set on the command line; faults of it are added.
CheckedTest test_of_case(const SimulateOptions& options, Faults& faults) {
  CheckedTest test;
  CaseDocument document;
  try {
    document = CaseDocument::load(options.case_file);
    for (const std::string& assignment : options.assignments)
      document.set_from_command_line(assignment, faults);
    test.scene = read_scene(document, faults);
  } catch (const InputError& error) {
    faults.add(error);
  }
  test.seed = seed_for(options, document, faults);
  return test;
}

/// The test, and the faults of everything that was asked for.
CheckedTest checked_test(const SimulateOptions& options) {
  Faults faults;
  CheckedTest test = test_of_case(options, faults);
  if (!options.out.empty()) check_folder(faults, options.out);
  check_range(faults, "--frames", options.frames, 0, kMostFrames,
              fmt::format("must be between 0 and {}", kMostFrames));
  check_range(faults, "--threads", options.threads, 1, Crew::kMostMembers,
              fmt::format("must be between 1 and {}", Crew::kMostMembers));
  if (options.frames > 0 && options.out.empty())
    faults.add("--frames", "", std::to_string(options.frames), "needs --out for the folder to write to");
  faults.throw_if_any();
  return test;
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
  const auto [scene, seed] = checked_test(options);
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

  const RunResult result = run_slump_test(scene, seed, run);
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
                   "(/numerics/time_step_fraction=0.2)")
      ->allow_extra_args(false);
  verb->add_option("--seed", options.seed, "Of the random numbers; default: the case's /sweep/seed, or 1");
  verb->add_option("--out", options.out,
                   "Folder for the result, the heap (VTK, dump) and the profile picture");
  verb->add_option("--threads", options.threads,
                   "That share the work of the test; default: 1. The result is the same");
  verb->add_option("--frames", options.frames, "Write this many instants of the test for ParaView, in --out");
}

}  // namespace repose::program
