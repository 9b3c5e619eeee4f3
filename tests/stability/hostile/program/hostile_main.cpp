#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/base/vec3.hpp"
#include "stability/hostile/sample/hostile_sample.hpp"

namespace {

using namespace repose::hostile;
using Json = nlohmann::ordered_json;

Json to_json(const SampleOptions& options, const SampleReport& report) {
  Json json = {{"seed", options.seed},
               {"cases", options.cases},
               {"outcomes", report.outcomes},
               {"completed_without_warning_of_the_motion", report.unquestioned},
               {"warnings_of_completed", report.warnings},
               {"largest_energy_imbalance_of_completed", report.largest_imbalance},
               {"cpu_s", report.cpu},
               {"slowest_s", report.slowest},
               {"slowest_case", report.slowest_index}};
  json["quarter_step"] = {{"runs", report.reruns.size()}, {"without_angle", report.reruns_without_angle}};
  if (report.reruns.size() > 1) {
    json["quarter_step"]["mean_difference_deg"] = repose::degrees(report.mean_difference());
    json["quarter_step"]["standard_error_deg"] = repose::degrees(report.error_of_mean_difference());
  }
  json["faults"] = Json::array();
  for (const SampleFault& fault : report.faults)
    json["faults"].push_back({{"case", fault.index}, {"fault", fault.text}});
  return json;
}

void print_outcomes(const SampleReport& report) {
  fmt::print("{:<20} {:>5}", "outcome", "cases");
  for (const double boldness : kBoldness) fmt::print(" {:>7.2f}", boldness);
  fmt::print("   share of values beyond the sensible ranges\n");
  for (const auto& [name, counts] : report.outcomes) {
    fmt::print("{:<20} {:>5}", name, std::accumulate(counts.begin(), counts.end(), 0));
    for (const int count : counts) fmt::print(" {:>7}", count);
    fmt::print("\n");
  }
  fmt::print("\n");
}

void print_table(const std::map<std::string, int>& counts, const char* heading) {
  fmt::print("{:<24} {:>5}\n", heading, "cases");
  for (const auto& [name, count] : counts) fmt::print("{:<24} {:>5}\n", name, count);
  fmt::print("\n");
}

void print_words(const SampleReport& report) {
  print_outcomes(report);
  print_table(report.warnings, "warning of completed");
  print_table(report.reruns_without_angle, "no angle at a quarter");
  fmt::print("completed and without a warning of the motion: {}\n", report.unquestioned);
  fmt::print("largest energy imbalance of a completed run: {:.0f} % of what was put in\n",
             100.0 * report.largest_imbalance);
  if (report.reruns.size() > 1)
    fmt::print("a quarter of the step changes the angle of {} runs by {:+.2f} ± {:.2f}° in the mean\n",
               report.reruns.size(), repose::degrees(report.mean_difference()),
               repose::degrees(report.error_of_mean_difference()));
  fmt::print("CPU time {:.0f} s; the slowest, case {}, {:.1f} s\n", report.cpu, report.slowest_index,
             report.slowest);
  for (const SampleFault& fault : report.faults) fmt::print("FAULT case {}: {}\n", fault.index, fault.text);
  fmt::print("{}\n", report.faults.empty() ? "no faults" : fmt::format("{} faults", report.faults.size()));
}

int run(int argc, char** argv) {
  SampleOptions options;
  bool json = false, quiet = false;
  std::int64_t show = -1;
  CLI::App app(
      "Random cases over and beyond the sensible ranges: does every one end with a sound angle or a named "
      "outcome?");
  app.name("tools/hostile");
  app.add_option("--cases", options.cases, "How many (500)")->check(CLI::Range(1, 1000000));
  app.add_option("--first", options.first, "Index of the first (0)");
  app.add_option("--seed", options.seed, "Of the sample (1)");
  app.add_option("--reruns", options.reruns, "Sound runs repeated with a quarter of the step (30)");
  app.add_option("--root", options.root, "The project's folder")->group("");
  app.add_option("--show", show, "Print this case instead, for `repose simulate`");
  app.add_flag("--json", json, "One JSON object");
  app.add_flag("--quiet", quiet, "No progress");
  CLI11_PARSE(app, argc, argv);
  if (show >= 0) {
    const HostileCase hostile = hostile_case(options.seed, static_cast<std::uint64_t>(show), options.root);
    fmt::print(stderr, "run it with --seed {}\n", hostile.seed);
    fmt::print("{}\n", hostile.json.dump(2));
    return 0;
  }
  if (!quiet)
    options.on_progress = [&](int done) {
      if (done % 25 == 0) fmt::print(stderr, "{} of {} cases\n", done, options.cases);
    };
  const SampleReport report = run_sample(options);
  if (json)
    fmt::print("{}\n", to_json(options, report).dump(2));
  else
    print_words(report);
  return report.faults.empty() ? 0 : 1;
}

}  // namespace

/// 0: every case ended as it must; 1: faults.
int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
