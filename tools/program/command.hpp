#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/input_error.hpp"

namespace repose::program {

/// How the program ends.
enum ExitCode : int {
  kDone = 0,
  kMachineFault = 1,   ///< disk full, out of memory, gnuplot missing
  kBadInput = 2,       ///< bad usage or bad input
  kNotCompleted = 3,   ///< a run ended otherwise than `completed`
  kInterrupted = 130,  ///< stopped by the user; everything finished is kept
};

/// What every verb understands.
struct CommonOptions {
  bool json = false;   ///< one JSON object on standard output and nothing else there
  bool quiet = false;  ///< no progress
};

/// The verb that the command line asks for; set while the command line is parsed, run afterwards.
using Action = std::function<int()>;

/// Adds a verb with --json and --quiet to the program. The options live as long as the program.
/// @param action  called with the parsed options if this verb is asked for
template <class Options>
Options& add_verb(CLI::App& app, Action& chosen, const std::string& name, const std::string& what,
                  int (*action)(const Options&), CLI::App*& verb) {
  auto options = std::make_shared<Options>();
  verb = app.add_subcommand(name, what);
  verb->add_flag("--json", options->common.json, "Print one JSON object on standard output, nothing else");
  verb->add_flag("--quiet", options->common.quiet, "Show no progress");
  verb->callback([&chosen, options, action] { chosen = [options, action] { return action(*options); }; });
  return *options;
}

/// Prints every fault on standard error, one a line; with --json also {"error", "faults"} on standard output.
/// Returns kBadInput.
int report_bad_input(const InputError& error, bool json);
/// Bad usage as the command line sees it: the same, without faults of files.
int report_bad_usage(const std::string& message, bool json);

/// Prints the object of --json.
void print_json(const nlohmann::ordered_json& object);

/// A finite number of this option between the bounds, otherwise a fault "--angle: 95: must be …".
void check_range(Faults& faults, const std::string& option, double value, double low, double high,
                 const std::string& rule);
/// --threads.
void check_threads(Faults& faults, int threads);

}  // namespace repose::program
