#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/run.hpp"
#include "fit/errors.hpp"
#include "tools/program/shape_verbs.hpp"
#include "tools/program/verbs.hpp"

namespace {

using namespace repose;
using namespace repose::program;

/// What is wrong with the command line, in words; CLI11's own where they are clear.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  const bool verb_given = argc > 1 && argv[1][0] != '-';
  const bool verb_known = verb_given && std::any_of(verbs.begin(), verbs.end(), [&](const CLI::App* verb) {
                            return verb->get_name() == argv[1];
                          });
  if (verb_known)
    return fmt::format("repose {}: {}\nrepose {} --help shows how it is used", argv[1], error.what(),
                       argv[1]);
  std::string names;
  for (const CLI::App* verb : verbs) names += (names.empty() ? "" : ", ") + verb->get_name();
  if (verb_given) return fmt::format("repose: there is no verb '{}'; there are: {}", argv[1], names);
  if (argc > 1)
    return fmt::format("repose: there is no option '{}' before the verb; verbs: {}", argv[1], names);
  return fmt::format("repose: {}; verbs: {}\nrepose --help says what they do", error.what(), names);
}

/// The words of the command line, backwards as CLI11 takes them. Options that take KEY=VALUE … are given
/// their name before each of them; a word behind them that names a file or a folder, such as the case, is not
/// theirs.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words;
  std::string list;              // the option whose values go on
  std::error_code no_such_name;  // a value may be longer than any file's name
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool names_list = word == "--set" || word == "--fix";
    const bool first = !words.empty() && words.back() == list;
    const bool goes_on = !first && !word.starts_with('-') && !std::filesystem::exists(word, no_such_name);
    if (names_list)
      list = word;
    else if (!list.empty() && goes_on)
      words.push_back(list);
    else if (!first)
      list.clear();
    words.push_back(word);
  }
  std::ranges::reverse(words);
  return words;
}

/// An option that is given a value takes none that is empty or looks like the next option: a value that was
/// forgotten, or a variable that is not set, is not to become the name of a file.
void refuse_forgotten_values(CLI::App& app) {
  const CLI::Validator given(
      [](const std::string& value) {
        if (value.empty()) return std::string("needs a value that is not empty");
        return value.starts_with("--") ? "needs a value, and '" + value + "' is an option" : std::string();
      },
      "");
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    for (CLI::Option* option : verb->get_options())
      if (option->get_expected_max() > 0) option->check(given);
}

/// What was written is on its way: a full disk is known only now.
int checked_output(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  fmt::print(stderr, "repose: standard output cannot be written\n");
  return status == kDone || status == kNotCompleted ? kMachineFault : status;
}

/// An angle that no friction within the domain gives: --json names the angles that are within reach.
int report_unreachable(const fit::Unreachable& error, bool json) {
  fmt::print(stderr, "{}\n", error.what());
  if (json)
    print_json({{"error", error.what()},
                {"reachable_deg", {error.reachable().low, error.reachable().high}},
                {"faults", nlohmann::ordered_json::array()}});
  return kBadInput;
}

int run(int argc, char** argv, bool json) {
  CLI::App app{"Repose: friction values for DEM simulations from a measured angle of repose", "repose"};
  app.set_version_flag("--version", "repose " REPOSE_VERSION " (engine " + engine_version() + ")");
  app.require_subcommand(1);
  Action chosen;
  add_calibrate(app, chosen);
  add_simulate(app, chosen);
  add_sweep(app, chosen);
  add_status(app, chosen);
  add_export(app, chosen);
  add_merge(app, chosen);
  add_chart(app, chosen);
  add_fit(app, chosen);
  add_invert(app, chosen);
  add_report(app, chosen);
  add_stability(app, chosen);
  add_shape(app, chosen);
  add_clump(app, chosen);
  refuse_forgotten_values(app);
  try {
    app.parse(words_of(argc, argv));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return report_bad_usage(usage_fault(app, error, argc, argv), json);
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  const bool json =
      std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--json"; });
  try {
    return checked_output(run(argc, argv, json));
  } catch (const InputError& error) {
    return report_bad_input(error, json);
  } catch (const fit::Unreachable& error) {
    return report_unreachable(error, json);
  } catch (const fit::Unusable& error) {
    return report_bad_usage(error.what(), json);
  } catch (const std::exception& error) {
    fmt::print(stderr, "repose: {}\n", error.what());
    if (json) print_json({{"error", error.what()}, {"faults", nlohmann::ordered_json::array()}});
    return kMachineFault;
  }
}
