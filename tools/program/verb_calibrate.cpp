#include <fmt/format.h>

#include <algorithm>

#include "fit/selection.hpp"
#include "sweep/plan.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/study_answer.hpp"
#include "tools/program/sweep_runner.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace {

struct CalibrateOptions {
  CommonOptions common;
  SweepRequest sweep;
  QuestionOptions question;
};

fit::Domain domain_of(const std::vector<fit::Observation>& table) {
  const auto range = [&table](double fit::Observation::*factor) {
    const auto [low, high] = std::ranges::minmax(table, {}, factor);
    return fit::Range{low.*factor, high.*factor};
  };
  fit::Domain domain;
  domain.e = range(&fit::Observation::e);
  domain.mu_s = range(&fit::Observation::mu_s);
  domain.mu_r = range(&fit::Observation::mu_r);
  return domain;
}

/// A fault where the design cannot give an equation, however its runs end: too few points, factors that only
/// vary together; or no answer to the question: values fixed outside the design, nothing left to solve for.
/// Faults of the case itself are the sweep's to find.
void check_that_an_answer_is_possible(const std::filesystem::path& case_file, const fit::Question& question,
                                      Faults& faults) {
  constexpr double kAnyAngle = 30.0;
  try {
    const sweep::Plan plan = sweep::make_plan(CaseDocument::load(case_file));
    std::vector<fit::Observation> table;
    for (const sweep::PlannedPoint& point : plan.points) {
      const ContactParameters& contact = point.scene.contact.particle_particle;
      table.push_back({.e = contact.restitution,
                       .mu_s = contact.static_friction,
                       .mu_r = contact.rolling_friction,
                       .angle = kAnyAngle});
    }
    const fit::Selection selection = fit::select_points(table);
    if (faults.empty())
      for (const std::string& fault : fit::faults_of(domain_of(selection.used), question))
        faults.add(case_file.string(), "/sweep", "", "cannot answer the question: " + fault);
  } catch (const InputError&) {
    return;
  } catch (const fit::Unusable& error) {
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    faults.add(case_file.string(), "/sweep", "", "no equation can be fitted to this design: " + reason);
  }
}

/// An angle out of reach is the user's to change; that no equation was found may be due to runs that did not
/// complete.
int exit_code_of_answer(const StudyAnswer& answer, const sweep::SweepSummary& summary) {
  const int of_sweep = exit_code_of(summary);
  if (answer.law && !answer.inversion) return kBadInput;
  if (of_sweep != kDone) return of_sweep;
  return answer.inversion ? kDone : kBadInput;
}

/// Runs the sweep and, where it was not interrupted, answers the question.
int calibrate(const CalibrateOptions& options) {
  Faults faults;
  const fit::Question question = question_of(options.question, faults);
  check_that_an_answer_is_possible(options.sweep.case_file, question, faults);
  HeapKeeper keeper(options.question.angle);
  SweepRequest request = options.sweep;
  request.quiet = options.common.quiet;
  request.on_finished = [&](const sweep::StoredRun& run, const RunResult& result) {
    keeper.see(run, result);
  };
  const sweep::SweepSummary summary = sweep_case(request, std::move(faults));
  if (!options.common.quiet) fmt::print(stderr, "{}\n", in_words(summary));
  if (summary.interrupted) {
    if (options.common.json) print_json({{"error", "interrupted"}, {"sweep", to_json(summary)}});
    return kInterrupted;
  }

  keep_question(request.folder, options.question);
  const sweep::Study study = sweep::open_study(request.folder);
  const StudyAnswer answer = answer_and_report(study, options.question, &keeper, options.common.quiet);
  const std::string source = request.folder.string();
  if (!answer.reason().empty()) fmt::print(stderr, "{}\n", answer.reason());
  if (options.common.json) {
    nlohmann::ordered_json json = to_json(answer, source);
    json["sweep"] = to_json(summary);
    print_json(json);
  } else {
    fmt::print("{}", in_words(answer, source));
  }
  return exit_code_of_answer(answer, summary);
}

}  // namespace

void add_calibrate(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "calibrate",
                           "The main job: sweep, fit, invert, report. From a case and a measured angle to "
                           "friction values",
                           calibrate, verb);
  verb->add_option("CASE", options.sweep.case_file, "The case, a JSON file with a \"sweep\"")->required();
  add_question(*verb, options.question)->required();
  verb->add_option("--out", options.sweep.folder, "Folder of the study and its report")->required();
  verb->add_option("--threads", options.sweep.threads, "Runs at a time; default: one a core");
}

}  // namespace repose::program
