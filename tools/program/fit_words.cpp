#include "tools/program/fit_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include <array>
#include <map>
#include <vector>

#include "tools/report/study_report.hpp"

namespace repose::program {

namespace {

constexpr std::array<const char*, 4> kNames = {"C", "a", "b", "c"};
/// Rows of the curve that are printed; the whole of it is in --json.
constexpr std::size_t kRows = 7;
/// Points left out for one reason that are printed one by one.
constexpr std::size_t kAlike = 3;

std::string point_in_words(const fit::Observation& row) {
  std::string text = fmt::format("e_pp = {:.4g}, mu_s = {:.4g}, mu_r = {:.4g}", row.e, row.mu_s, row.mu_r);
  return row.label.empty() ? text : row.label + " (" + text + ")";
}

std::string range_in_words(const fit::Range& range) {
  return fmt::format("{:.4g} … {:.4g}", range.low, range.high);
}

/// "reference = cheap × 1.05 μs^0.02 …".
std::string correction_in_words(const fit::Correction& correction) {
  std::string text = fmt::format(
      "the reference's equation, of {} rows of the reference and {} of the cheap test:\n"
      "  reference = cheap × {:.4g} (± {:.2g})",
      correction.reference_rows, correction.cheap_rows, correction.C.value, correction.C.standard_error);
  for (const auto& [name, exponent] :
       {std::pair{"e", &correction.a}, {"μr", &correction.b}, {"μs", &correction.c}})
    if (exponent->identified)
      text += fmt::format(" × {}^{:.4g} (± {:.2g})", name, exponent->value, exponent->standard_error);
  return text + "\n";
}

/// A line for each point; one for all of a reason that many have. --json names each.
std::string excluded_in_words(const std::vector<fit::Excluded>& excluded) {
  std::map<std::string, std::vector<const fit::Excluded*>> of_reason;
  for (const fit::Excluded& row : excluded) of_reason[row.reason].push_back(&row);
  std::string text;
  for (const fit::Excluded& row : excluded) {
    const auto& alike = of_reason[row.reason];
    if (alike.size() <= kAlike)
      text += fmt::format("left out: {}: {}\n", point_in_words(row.observation), row.reason);
    else if (alike.front() == &row)
      text += fmt::format("left out: {} points, the first {}: {}\n", alike.size(),
                          point_in_words(row.observation), row.reason);
  }
  return text;
}

}  // namespace

std::string in_words(const fit::PowerLaw& law) {
  std::string text = report::equation_in_words(law) + "   (degrees)\n";
  const auto parameters = law.parameters();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const fit::Estimate& estimate = *parameters[i];
    if (!estimate.identified)
      text += fmt::format("  {} = 0: its factor does not vary\n", kNames[i]);
    else
      text += fmt::format("  {} = {:.4g} ± {:.2g}  (95 %: {})\n", kNames[i], estimate.value,
                          estimate.standard_error, range_in_words(estimate.interval_95));
  }
  if (law.correction) text += correction_in_words(*law.correction);
  text +=
      fmt::format("{} points, {} loss; RMS error {:.2f}°{}\n", law.points, name_of(law.loss), law.rms_error,
                  std::isfinite(law.r_squared) ? fmt::format(", R² {:.4f}", law.r_squared) : "");
  text += fmt::format("worst error {:.2f}° at {}\n", law.worst_error, point_in_words(law.worst_point));
  text += fmt::format("holds for e_pp {}, mu_s {}, mu_r {}\n", range_in_words(law.domain.e),
                      range_in_words(law.domain.mu_s), range_in_words(law.domain.mu_r));
  text += excluded_in_words(law.excluded);
  for (const std::string& remark : law.remarks) text += "note: " + remark + "\n";
  return text;
}

std::string curve_in_words(const fit::Inversion& inversion) {
  const auto& curve = inversion.level_set;
  const std::size_t rows = std::min(kRows, curve.size());
  if (inversion.solution || rows == 0) return {};
  std::string text = "    mu_s   95 % at this mu_r       mu_r   95 % at this mu_s\n";
  for (std::size_t i = 0; i < rows; ++i) {
    const fit::LevelPoint& at = curve[rows == 1 ? 0 : i * (curve.size() - 1) / (rows - 1)];
    text += fmt::format("{:8.4f}   {:.4f} … {:.4f}      {:7.4f}   {:.4f} … {:.4f}\n", at.mu_s,
                        at.mu_s_band.low, at.mu_s_band.high, at.mu_r, at.mu_r_band.low, at.mu_r_band.high);
  }
  return text;
}

}  // namespace repose::program
