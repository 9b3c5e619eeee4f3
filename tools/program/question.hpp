#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/input_error.hpp"
#include "fit/inversion.hpp"
#include "fit/power_law.hpp"

namespace repose::program {

/// A measured angle and what is known besides, as it is typed: --angle, --sigma, --fix, --loss.
struct QuestionOptions {
  double angle = 0.0;
  double sigma = 0.0;
  std::vector<std::string> fixed;  ///< "mu_r=0.1"
  std::string loss = name_of(fit::Loss::least_squares);
};

/// Adds --angle (returned, so that a verb can demand it), --sigma, --fix and --loss to a verb.
CLI::Option* add_question(CLI::App& verb, QuestionOptions& options);

/// The question, and faults for what is wrong with it: an angle that is not between 0 and 90 degrees, a
/// negative sigma, a --fix that is no e_pp, mu_s or mu_r = number, or given twice.
fit::Question question_of(const QuestionOptions& options, Faults& faults);

/// For a study's folder, so that its report can be made again: angle_deg, sigma_deg, fixed, loss.
nlohmann::ordered_json to_json(const QuestionOptions& options);
QuestionOptions question_from_json(const nlohmann::ordered_json& json);

}  // namespace repose::program
