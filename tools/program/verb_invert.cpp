#include <fmt/format.h>

#include "fit/fit_json.hpp"
#include "tools/program/fit_words.hpp"
#include "tools/program/question.hpp"
#include "tools/program/response_source.hpp"
#include "tools/program/verbs.hpp"
#include "tools/report/study_report.hpp"

namespace repose::program {

namespace {

struct InvertOptions {
  CommonOptions common;
  std::string source;
  CLI::Option* loss = nullptr;  ///< tells whether --loss was given
  QuestionOptions question;
};

/// The equation; a saved one was fitted by a loss of its own.
fit::PowerLaw law_for(const InvertOptions& options) {
  const fit::Loss loss = fit::loss_named(options.question.loss);
  fit::PowerLaw law = law_of(options.source, loss);
  if (options.loss->count() > 0 && law.loss != loss)
    throw InputError(
        {"--loss", "", options.question.loss,
         fmt::format("{} is a saved fit, made with {}: fit again", options.source, name_of(law.loss))});
  return law;
}

int invert_verb(const InvertOptions& options) {
  Faults faults;
  const fit::Question question = question_of(options.question, faults);
  fit::PowerLaw law;
  try {
    law = law_for(options);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  const fit::Inversion inversion = fit::invert(law, question);
  if (options.common.json)
    print_json(fit::to_json(inversion));
  else
    fmt::print("{}{}", report::answer_in_words(law, inversion, options.source), curve_in_words(inversion));
  return kDone;
}

}  // namespace

void add_invert(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "invert", "Friction values that give a measured angle of repose",
                           invert_verb, verb);
  verb->add_option("SOURCE", options.source,
                   "A sweep's folder, a CSV with the columns e_pp,mu_s,mu_r,angle_deg, or a saved fit "
                   "(repose fit SOURCE --json > fit.json)")
      ->required();
  add_question(*verb, options.question)->required();
  options.loss = verb->get_option("--loss");
}

}  // namespace repose::program
