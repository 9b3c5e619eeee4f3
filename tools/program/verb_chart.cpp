#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chart/chart_files.hpp"
#include "chart/chosen_case.hpp"
#include "chart/default_ladder.hpp"
#include "tools/program/chart_words.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/sweep_runner.hpp"
#include "tools/program/verbs.hpp"
#include "tools/report/chart_picture.hpp"

namespace repose::program {

namespace {

struct ChartOptions {
  CommonOptions common;
  SweepRequest sweep;
  std::optional<double> limit;
  int tries = 5;
};

/// A combination that was tried.
struct Trial {
  sweep::Variant variant;
  chart::Judgement predicted;
  double predicted_speed_up = 0.0;
  chart::Comparison measured;

  [[nodiscard]] bool within(double limit) const {
    return measured.completed && measured.angle.bound_95 < limit;
  }
};

/// What a call has done so far.
struct Session {
  const ChartOptions& options;
  std::vector<sweep::Variant> combinations;  ///< that were added to the ladder
  sweep::SweepSummary summary;
  chart::Chart chart;
  std::vector<Trial> trials;
  const Trial* chosen = nullptr;
  std::string remark;  ///< why nothing was chosen, or what is to be known of the choice

  /// Makes what is missing of the ladder with its combinations, and reads what is there; false: interrupted.
  bool measure(Faults faults = {}) {
    SweepRequest request = options.sweep;
    request.quiet = options.common.quiet;
    request.prepare = [this](const CaseDocument& document) {
      return chart::with_rungs(chart::with_chart(document), combinations);
    };
    summary = sweep_case(request, std::move(faults));
    chart = chart::read_chart(request.folder);
    return !summary.interrupted;
  }
};

/// The rung of the ladder that a combination of one is, else a new one: its name, free in the ladder.
sweep::Variant named(sweep::Variant variant, const chart::Chart& chart) {
  while (std::ranges::find(chart.variants, variant.name, &sweep::Variant::name) != chart.variants.end())
    variant.name += " (combined)";
  return variant;
}

const chart::Comparison& measured(const chart::Chart& chart, const std::string& name) {
  return *std::ranges::find(chart.rungs, name, &chart::Comparison::name);
}

/// Why nothing could be tried: the noise, and how many replicates would do at best, or the rungs.
std::string nothing_near(const chart::Chart& chart, double limit) {
  double noise = HUGE_VAL;
  for (const chart::Comparison& rung : chart.rungs)
    if (rung.completed) noise = std::min(noise, rung.angle.noise_bound_95);
  std::string text =
      fmt::format("no combination can be said to be within {:g}° with 95 % confidence: ", limit);
  if (!std::isfinite(noise)) return text + "no rung was completed";
  if (noise < limit) return text + "the rungs are too coarse; give finer ones, or more replicates";
  const double needed = std::ceil(chart.replicates * std::pow(noise / limit, 2));
  return text + fmt::format("with {} replicates the noise alone leaves {:.2g}° at best; give some {:.0f}",
                            chart.replicates, noise, needed);
}

/// Tries the cheapest combinations that should do until one does; false: interrupted.
bool choose(Session& session, double limit) {
  const std::vector<chart::Candidate> candidates = chart::candidates_of(session.chart);
  const std::vector<chart::Combination> combinations =
      chart::combinations_within(limit, candidates, chart::working_point_of(session.chart));
  session.trials.reserve(static_cast<std::size_t>(session.options.tries));
  std::size_t next = 0;
  while (next < combinations.size() && static_cast<int>(session.trials.size()) < session.options.tries) {
    const chart::Combination& combination = combinations[next];
    Trial trial{chart::variant_of(combination, candidates, session.chart),
                combination.predicted,
                1.0 / combination.cost_ratio,
                {}};
    if (combination.rungs.size() > 1) {
      trial.variant = named(std::move(trial.variant), session.chart);
      session.combinations.push_back(trial.variant);
      if (!session.measure()) return false;
    }
    trial.measured = measured(session.chart, trial.variant.name);
    session.trials.push_back(std::move(trial));
    if (session.trials.back().within(limit)) {
      session.chosen = &session.trials.back();
      if (candidates.size() > 1)
        session.remark = fmt::format(
            "its bound is that of one that nobody picked: of {} rungs that were compared by the same runs "
            "the "
            "luckiest looks best. Chart it with another /chart/seed where much hangs on it",
            candidates.size());
      return true;
    }
    next = chart::next_after(combinations, combination.cost_ratio);
  }
  session.remark =
      session.trials.empty()
          ? nothing_near(session.chart, limit)
          : fmt::format(
                "none of the {} combinations that were tried is within {:g}° with 95 % confidence; give more "
                "replicates, finer rungs or more --tries",
                session.trials.size(), limit);
  return true;
}

std::string title_of(const Session& session) {
  return fmt::format(
      "{}{}simplified for speed: {} (within {:g}° of its reference and {:.3g} times cheaper; made by "
      "repose chart --choose)",
      session.chart.title, session.chart.title.empty() ? "" : "; ", session.chosen->variant.name,
      *session.options.limit, session.chosen->measured.speed_up);
}

void write_chart(const Session& session) {
  const std::filesystem::path& folder = session.options.sweep.folder;
  write_file(folder / "chart.csv", chart::chart_csv(session.chart));
  for (const char* picture : {"chart.svg", "chart.png"}) report::draw_chart(folder / picture, session.chart);
  if (session.options.limit) std::filesystem::remove(folder / "chosen.json");  // of an earlier choice
  if (session.chosen == nullptr) return;
  const CaseDocument given = CaseDocument::load(session.options.sweep.case_file);
  const sweep::Variant reference = chart::anywhere(session.chart.reference_variant, session.chart);
  const auto json =
      chart::chosen_case(given, {reference, session.chosen->variant}, folder, title_of(session));
  write_file(folder / "chosen.json", json.dump(2) + "\n");
}

nlohmann::ordered_json session_json(const Session& session) {
  nlohmann::ordered_json json = chart::to_json(session.chart);
  json["sweep"] = to_json(session.summary);
  if (!session.options.limit) return json;
  auto trials = nlohmann::ordered_json::array();
  for (const Trial& trial : session.trials) {
    auto one = chart::to_json(trial.measured, *std::ranges::find(session.chart.variants, trial.variant.name,
                                                                 &sweep::Variant::name));
    one["predicted"] = {{"error_deg", trial.predicted.error},
                        {"error_bound_95_deg", trial.predicted.bound_95},
                        {"speed_up", trial.predicted_speed_up}};
    trials.push_back(std::move(one));
  }
  json["choice"] = {
      {"limit_deg", *session.options.limit},
      {"chosen", session.chosen ? nlohmann::ordered_json(session.chosen->variant.name) : nullptr},
      {"case", session.chosen
                   ? nlohmann::ordered_json((session.options.sweep.folder / "chosen.json").string())
                   : nullptr},
      {"remark", session.remark},
      {"trials", std::move(trials)}};
  return json;
}

void print_session(const Session& session) {
  fmt::print("{}", in_words(session.chart));
  for (const Trial& trial : session.trials)
    fmt::print("tried {}: expected {:.2f}° off (below {:.2f}°) and {:.3g} times cheaper; measured {}\n",
               trial.variant.name, trial.predicted.error, trial.predicted.bound_95, trial.predicted_speed_up,
               in_words(trial.measured));
  const std::filesystem::path& folder = session.options.sweep.folder;
  if (session.chosen)
    fmt::print("chosen: {}: {}\n", session.chosen->variant.name, (folder / "chosen.json").string());
  if (!session.remark.empty()) fmt::print("{}\n", session.remark);
  fmt::print("written to {}\n", folder.string());
}

/// The chart of what is there. It is not written: files are of the whole ladder.
void print_interrupted(const Session& session) {
  const bool there = session.chart.has_reference();
  if (session.options.common.json) {
    nlohmann::ordered_json json = {{"sweep", to_json(session.summary)}};
    json["so_far"] = there ? chart::to_json(session.chart) : nlohmann::ordered_json();
    print_json(json);
    return;
  }
  fmt::print("{}\n", in_words(session.summary));
  if (there)
    fmt::print("{}", in_words(session.chart));
  else if (session.chart.reference_failure.empty())
    fmt::print("no chart yet: it begins with two replicates of the reference\n");
  else
    fmt::print("{}\n", reference_failed(session.chart));
}

int chart_verb(const ChartOptions& options) {
  Faults faults;
  if (options.limit)
    check_range(faults, "--choose", *options.limit, 1e-6, 90.0, "must be above 0 and at most 90 degrees");
  check_range(faults, "--tries", options.tries, 1, 1000, "must be between 1 and 1000");
  Session session{options, {}, {}, {}, {}, nullptr, {}};
  bool complete = session.measure(std::move(faults));
  if (complete && !session.chart.has_reference()) {
    fmt::print(stderr, "{}\n", reference_failed(session.chart));
    if (options.common.json)
      print_json({{"error", reference_failed(session.chart)}, {"sweep", to_json(session.summary)}});
    return kNotCompleted;
  }
  if (complete && options.limit) complete = choose(session, *options.limit);
  if (!complete) {
    print_interrupted(session);
    return kInterrupted;
  }
  const nlohmann::ordered_json json = session_json(session);
  write_chart(session);
  write_file(options.sweep.folder / "chart.json", json.dump(2) + "\n");
  if (options.common.json)
    print_json(json);
  else
    print_session(session);
  return options.limit && session.chosen == nullptr ? kNotCompleted : exit_code_of(session.summary);
}

}  // namespace

void add_chart(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "chart",
                           "Speed against accuracy: what each simplification costs and saves on a case",
                           chart_verb, verb);
  verb->add_option("CASE", options.sweep.case_file,
                   "The case, a JSON file; its \"chart\" holds the ladder, without it a default one is made")
      ->required();
  verb->add_option(
          "--out", options.sweep.folder,
          "Folder of the study, and for chart.csv, chart.json, chart.png, chart.svg (and chosen.json)")
      ->required();
  verb->add_option("--threads", options.sweep.threads, "Runs at a time; default: one a core");
  verb->add_option(
      "--choose", options.limit,
      "DEG: find the cheapest combination whose error is below this with 95 % confidence, run it to "
      "confirm it, and write the case chosen.json");
  verb->add_option("--tries", options.tries, "Combinations that --choose may run; default: 5");
}

}  // namespace repose::program
