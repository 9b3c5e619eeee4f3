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
  QuestionOptions question;
};

int invert_verb(const InvertOptions& options) {
  Faults faults;
  const fit::Question question = question_of(options.question, faults);
  faults.throw_if_any();
  const fit::PowerLaw law = law_of(options.source, fit::loss_named(options.question.loss));
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
}

}  // namespace repose::program
