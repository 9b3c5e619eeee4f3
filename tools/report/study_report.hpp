#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/inversion.hpp"
#include "fit/power_law.hpp"
#include "fit/response_table.hpp"

namespace repose::report {

/// A line "name: value" of a list.
struct Fact {
  std::string name;
  std::string value;
};

/// A list with a heading: "Particles", "Walls", …
struct FactGroup {
  std::string heading;
  std::vector<Fact> facts;
};

/// A picture that the page carries inside itself.
struct Picture {
  std::filesystem::path file;  ///< PNG, JPEG or SVG
  std::string caption;
};

/// One run of the study as the table of runs shows it.
struct RunRow {
  fit::Observation observation;  ///< the same row that went into the fit
  std::string outcome;           ///< "completed", "no_heap", …
  std::optional<double> cpu;     ///< CPU time [s]
  std::string warnings = {};     ///< names of its warnings, joined by blanks; may be empty
};

/// A warning that runs of the equation carry.
struct WarningRow {
  std::string name;
  int runs = 0;
  std::string example;  ///< what it says in the first of them
};

/// Everything that the page says, as plain data. What is not there (no fit, no measured angle, no pictures)
/// is left out of the page, with the reason where one is given.
struct ReportData {
  std::string title;  ///< of the case
  std::string
      source;  ///< the study as a command names it ("calibration"), for the commands that are proposed
  std::optional<fit::PowerLaw> law;
  std::string law_reason;  ///< why there is no law
  std::optional<fit::Inversion> inversion;
  std::string
      inversion_reason;  ///< why there is no inversion (an angle out of reach); empty if none was asked
  std::vector<RunRow> runs;
  std::string edge;  ///< how many heaps the base's edge cuts; may be empty
  std::vector<WarningRow> warnings;
  std::vector<Picture> heaps;
  std::vector<FactGroup> inputs;  ///< of the scene
  std::vector<Fact> cost;
  std::string made_by;  ///< program, version, date: the last line of the page
};

/// Writes DIR/report.html: one page without any other file, and DIR/level_set.svg and
/// DIR/predicted_simulated.svg, the charts that it holds. DIR is made if need be.
/// @return the page
/// Throws std::runtime_error: gnuplot missing, a picture that cannot be read, a folder that cannot be
/// written.
std::filesystem::path write_report(const std::filesystem::path& dir, const ReportData& data);

/// A paragraph that begins so is a command to copy.
inline constexpr const char* kCommand = "  ";

/// The answer in sentences, one paragraph each: the friction values of the angle, what restitution does to
/// it, what to fix next, where the band comes from, and what the equation is worth.
/// @param source  as in ReportData; without it no command is proposed
std::vector<std::string> answer_paragraphs(const fit::PowerLaw& law, const fit::Inversion& inversion,
                                           const std::string& source = {});

/// answer_paragraphs, one a line, each broken at 100 characters: for a terminal.
std::string answer_in_words(const fit::PowerLaw& law, const fit::Inversion& inversion,
                            const std::string& source = {});

/// `α = 56.61 e^0.01 μr^0.084 μs^0.25`, without factors whose exponent is not identified.
std::string equation_in_words(const fit::PowerLaw& law);

}  // namespace repose::report
