#include "tools/program/question.hpp"

#include <fmt/format.h>

#include "engine/base/csv.hpp"

namespace repose::program {

namespace {

/// Puts "mu_r=0.1" into the question.
void fix(fit::Question& question, const std::string& assignment, Faults& faults) {
  const std::size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  std::optional<double>* slot = name == "e_pp"   ? &question.e
                                : name == "mu_s" ? &question.mu_s
                                : name == "mu_r" ? &question.mu_r
                                                 : nullptr;
  const auto value = equals == std::string::npos ? std::nullopt : parse_number(assignment.substr(equals + 1));
  if (slot == nullptr || !value)
    faults.add("--fix", "", assignment, "must be e_pp, mu_s or mu_r = a number, such as mu_r=0.1");
  else if (slot->has_value())
    faults.add("--fix", "", assignment, name + " is fixed twice");
  else
    *slot = value;
}

}  // namespace

CLI::Option* add_question(CLI::App& verb, QuestionOptions& options) {
  CLI::Option* angle = verb.add_option("--angle", options.angle, "The measured angle of repose [degrees]");
  verb.add_option("--sigma", options.sigma, "Its standard error [degrees]")->capture_default_str();
  verb.add_option("--fix", options.fixed, "KEY=VALUE …: what is known besides, such as mu_r=0.1 or e_pp=0.3")
      ->allow_extra_args(false);
  verb.add_option("--loss", options.loss, "What the fit makes smallest: the squared errors or the worst one")
      ->check(CLI::IsMember({name_of(fit::Loss::least_squares), name_of(fit::Loss::minimax)}))
      ->capture_default_str();
  return angle;
}

fit::Question question_of(const QuestionOptions& options, Faults& faults) {
  if (!(options.angle > 0.0 && options.angle < 90.0))
    faults.add("--angle", "", fmt::format("{}", options.angle), "must be between 0 and 90 degrees");
  if (!(options.sigma >= 0.0 && options.sigma < 90.0))
    faults.add("--sigma", "", fmt::format("{}", options.sigma), "must be 0 degrees or more, and below 90");
  fit::Question question;
  question.angle = options.angle;
  question.sigma = options.sigma;
  for (const std::string& assignment : options.fixed) fix(question, assignment, faults);
  return question;
}

nlohmann::ordered_json to_json(const QuestionOptions& options) {
  return {{"angle_deg", options.angle},
          {"sigma_deg", options.sigma},
          {"fixed", options.fixed},
          {"loss", options.loss}};
}

QuestionOptions question_from_json(const nlohmann::ordered_json& json) {
  QuestionOptions options;
  options.angle = json.at("angle_deg").get<double>();
  options.sigma = json.at("sigma_deg").get<double>();
  options.fixed = json.at("fixed").get<std::vector<std::string>>();
  options.loss = json.at("loss").get<std::string>();
  return options;
}

}  // namespace repose::program
