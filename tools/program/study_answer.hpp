#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "sweep/study.hpp"
#include "tools/program/heap_gallery.hpp"
#include "tools/program/question.hpp"

namespace repose::program {

/// What a study says, as far as it goes.
struct StudyAnswer {
  std::optional<fit::PowerLaw> law;
  std::string law_reason;  ///< why there is none
  std::optional<fit::Inversion> inversion;
  std::string inversion_reason;                         ///< why there is none, empty if no question was asked
  std::optional<fit::Range> reachable;                  ///< [deg], where the angle is out of reach
  std::map<std::string, sweep::WarningCount> warnings;  ///< of the runs that the equation rests on
  std::filesystem::path report;                         ///< the page

  /// Why there is no answer to the question; empty if there is.
  [[nodiscard]] const std::string& reason() const { return law ? inversion_reason : law_reason; }
};

/// Fits a study, answers the question and writes its report into its folder.
/// @param question  a question that has been checked; none: only the equation
/// @param keeper    heaps that need not be simulated again, or nullptr
StudyAnswer answer_and_report(const sweep::Study& study, const std::optional<QuestionOptions>& question,
                              const HeapKeeper* keeper, bool quiet);

/// answer (in words), fit, inversion, report; error and reachable_deg where there is no answer.
nlohmann::ordered_json to_json(const StudyAnswer& answer, const std::string& source);
std::string in_words(const StudyAnswer& answer, const std::string& source);

/// The question of a study, kept in its folder for the next report.
void keep_question(const std::filesystem::path& folder, const QuestionOptions& question);
std::optional<QuestionOptions> kept_question(const std::filesystem::path& folder);

}  // namespace repose::program
