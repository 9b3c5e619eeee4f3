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
  CLI::App* verb = nullptr;  ///< tells which options were given

  [[nodiscard]] bool given(const char* option) const { return verb->get_option(option)->count() > 0; }
  QuestionOptions question;
};

/// The question of the command line; without an angle the one that the study was last asked, with what the
/// command line changes in it.
std::optional<QuestionOptions> question_for(const ReportOptions& options) {
  const QuestionOptions& typed = options.question;
  if (options.given("--angle")) return typed;
  std::optional<QuestionOptions> question = kept_question(options.folder);
  for (const char* option : {"--sigma", "--fix", "--loss"})
    if (options.given(option) && !question)
      throw InputError({option, "", "", "needs --angle: the study has not been asked a question yet"});
  if (options.given("--sigma")) question->sigma = typed.sigma;
  if (options.given("--fix")) question->fixed = typed.fixed;
  if (options.given("--loss")) question->loss = typed.loss;
  return question;
}

bool asks(const ReportOptions& options) {
  return options.given("--angle") || options.given("--sigma") || options.given("--fix") ||
         options.given("--loss");
}

int report_verb(const ReportOptions& options) {
  Faults faults;
  if (options.given("--angle")) question_of(options.question, faults);
  std::optional<sweep::Study> opened;
  std::optional<QuestionOptions> question;
  try {
    opened = sweep::open_study(options.folder);
    question = question_for(options);
    if (question && !options.given("--angle")) question_of(*question, faults);
    check_folder(faults, options.folder);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  const sweep::Study& study = *opened;
  const StudyAnswer answer = answer_and_report(study, question, nullptr, options.common.quiet);
  if (asks(options)) keep_question(options.folder, *question);
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
  add_question(*verb, options.question);
  options.verb = verb;
}

}  // namespace repose::program
