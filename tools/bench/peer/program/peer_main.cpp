#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "engine/base/input_error.hpp"
#include "engine/base/json_file.hpp"
#include "engine/scene/scene_reader.hpp"
#include "tools/bench/peer/comparison.hpp"
#include "tools/bench/peer/liggghts_case.hpp"
#include "tools/bench/peer/liggghts_dump.hpp"
#include "tools/bench/peer/reading.hpp"

namespace {

using namespace repose;
using Json = nlohmann::ordered_json;

struct Options {
  std::string case_file;
  std::vector<std::string> assignments;
  std::uint64_t seed = 1;
  std::string repose_result;
  std::string folder;
  bool json = false;
};

Scene scene_of(const Options& options) {
  CaseDocument document = CaseDocument::load(options.case_file);
  Faults faults;
  for (const std::string& assignment : options.assignments)
    document.set_from_command_line(assignment, faults);
  Scene scene = read_scene(document, faults);
  faults.throw_if_any();
  return scene;
}

int write_verb(const Options& options) {
  const Scene scene = scene_of(options);
  peer::write_liggghts_case(scene, options.seed, peer::schedule_of(read_json(options.repose_result)),
                            options.folder);
  return 0;
}

int read_verb(const Options& options) {
  fmt::print("{}\n", peer::read_run(scene_of(options), options.seed, options.folder).dump(2));
  return 0;
}

int table_verb(const Options& options) {
  const std::vector<peer::Comparison> table = peer::compare(peer::read_runs(options.folder));
  fmt::print("{}", options.json ? peer::to_json(table).dump(2) + "\n" : peer::in_words(table));
  for (const peer::Comparison& row : table)
    if (!row.passed()) return 1;
  return 0;
}

void add_case(CLI::App& verb, Options& options) {
  verb.add_option("CASE", options.case_file)->required();
  verb.add_option("--set", options.assignments, "KEY=VALUE, as of `repose simulate`");
  verb.add_option("--seed", options.seed);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("The same slump test in LIGGGHTS: its input written, its dumps read, both programs compared");
  app.require_subcommand(1);
  CLI::App* write = app.add_subcommand("write", "LIGGGHTS's input script, walls and clumps for a case");
  add_case(*write, options);
  write
      ->add_option("--repose", options.repose_result,
                   "what `repose simulate --json` said: when the stages begin")
      ->required();
  CLI::App* read = app.add_subcommand("read", "angle, bulk density and rest from LIGGGHTS's dumps, as JSON");
  add_case(*read, options);
  CLI::App* table =
      app.add_subcommand("table", "both programs' runs below a folder, compared; 1 if a bar is missed");
  table->add_flag("--json", options.json);
  for (CLI::App* verb : {write, read, table}) verb->add_option("DIR", options.folder)->required();
  CLI11_PARSE(app, argc, argv);
  if (*write) return write_verb(options);
  return *read ? read_verb(options) : table_verb(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const repose::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
