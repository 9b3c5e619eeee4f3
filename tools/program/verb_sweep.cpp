#include <fmt/format.h>

#include "tools/program/sweep_runner.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace {

struct SweepVerbOptions {
  CommonOptions common;
  SweepRequest request;
};

int sweep_verb(const SweepVerbOptions& options) {
  SweepRequest request = options.request;
  request.quiet = options.common.quiet;
  const sweep::SweepSummary summary = sweep_case(request);
  if (options.common.json)
    print_json(to_json(summary));
  else
    fmt::print("{}\n", in_words(summary));
  return exit_code_of(summary);
}

}  // namespace

void add_sweep(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "sweep", "All runs of a case's design that DIR does not hold yet",
                           sweep_verb, verb);
  verb->add_option("CASE", options.request.case_file, "The case, a JSON file with a \"sweep\"")->required();
  verb->add_option("--out", options.request.folder, "Folder of the study (study.sqlite)")->required();
  verb->add_option("--threads", options.request.threads, "Runs at a time; default: one a core");
  verb->add_option("--shard", options.request.shard, "I/N: only this part of the runs, for N machines");
}

}  // namespace repose::program
