#include <fmt/format.h>

#include <optional>

#include "tools/program/output_folder.hpp"
#include "tools/program/study_answer.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace {

struct ReportOptions {
  CommonOptions common;
  std::filesystem::path folder;
  CLI::Option* angle = nullptr;  ///< tells whether --angle was given
  QuestionOptions question;
};

/// The question of the command line, or else the one that the study was last asked.
std::optional<QuestionOptions> question_for(const ReportOptions& options) {
  if (options.angle->count() == 0) return kept_question(options.folder);
  Faults faults;
  question_of(options.question, faults);
  faults.throw_if_any();
  return options.question;
}

int report_verb(const ReportOptions& options) {
  const sweep::Study study = sweep::open_study(options.folder);
  const std::optional<QuestionOptions> question = question_for(options);
  Faults faults;
  check_folder(faults, options.folder);
  faults.throw_if_any();
  const StudyAnswer answer = answer_and_report(study, question, nullptr, options.common.quiet);
  if (options.angle->count() > 0) keep_question(options.folder, options.question);
  const std::string source = options.folder.string();
  if (!answer.reason().empty()) fmt::print(stderr, "{}\n", answer.reason());
  if (options.common.json)
    print_json(to_json(answer, source));
  else
    fmt::print("{}", in_words(answer, source));
  return answer.reason().empty() ? kDone : kBadInput;
}

}  // namespace

void add_report(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "report", "The report of a study, again", report_verb, verb);
  verb->add_option("DIR", options.folder, "Folder of the study")->required();
  options.angle = add_question(*verb, options.question);
}

}  // namespace repose::program
