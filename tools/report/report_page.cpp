#include "tools/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tools/report/report_charts.hpp"
#include "tools/report/report_html.hpp"
#include "tools/report/report_style.hpp"

namespace repose::report {
namespace {

constexpr std::size_t kOpenRows = 40;  // a longer table of runs is folded

// A minus sign as long as a plus.
std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string number(double value, int digits = 3) {
  return std::isfinite(value) ? with_minus(fmt::format("{:.{}g}", value, digits)) : "–";
}

/// So many decimals that two digits of the standard error show.
std::string like_error(double value, double standard_error) {
  if (!(standard_error > 0.0)) return number(value, 4);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(standard_error))), 0, 8);
  return with_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string range(const fit::Range& r) {
  return r.low == r.high ? number(r.low) : number(r.low) + " … " + number(r.high);
}

std::string card(const std::string& inside) { return "<div class=\"card\">" + inside + "</div>\n"; }

std::string figure(const std::filesystem::path& picture, const std::string& alternative,
                   const std::string& caption) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>",
                     data_address(picture), escaped(alternative), caption);
}

// Rows have no number of their own; their settings, repeat and label are one together.
std::string key_of(const fit::Observation& row) {
  return fmt::format("{}|{}|{}|{}|{}", row.e, row.mu_s, row.mu_r, row.replicate, row.label);
}

std::map<std::string, std::string> reasons_of(const ReportData& data) {
  std::map<std::string, std::string> reasons;
  if (data.law) {
    for (const fit::Excluded& row : data.law->excluded) reasons[key_of(row.observation)] = row.reason;
  }
  return reasons;
}

std::string headline(const fit::Inversion& inversion) {
  if (!inversion.solution || !inversion.identifiable) {
    return fmt::format(
        "<p class=\"answer\">{}<br><span class=\"unit\">for a measured angle of {}°{}</span></p>",
        typeset(inversion.solution ? "No value can be told" : "A curve of (μs, μr)"),
        number(inversion.question.angle, 4),
        inversion.question.sigma > 0.0 ? " ± " + number(inversion.question.sigma, 2) + "°" : "");
  }
  const fit::Solution& s = *inversion.solution;
  const bool sliding = s.solved_mu_s;
  const fit::Range interval =
      sliding ? fit::Range{s.low.mu_s, s.high.mu_s} : fit::Range{s.low.mu_r, s.high.mu_r};
  return "<p class=\"answer\">" +
         typeset(
             fmt::format("{} = {}", sliding ? "μs" : "μr", number(sliding ? s.value.mu_s : s.value.mu_r))) +
         "<br><span class=\"unit\">" +
         typeset(fmt::format("95 %: {}, with {} = {} and e = {}", range(interval), sliding ? "μr" : "μs",
                             number(sliding ? s.value.mu_r : s.value.mu_s), number(inversion.e))) +
         "</span></p>";
}

std::string friction_caption(const ReportData& data) {
  if (!spans_plane(*data.law)) {
    return typeset(
        "Circles: simulated angles. Line: the equation. Shaded: the measured angle, 95 %. Black: the "
        "value that gives it, with its interval.");
  }
  std::string text =
      "Circles: pairs that were simulated, with their mean angle. Grey lines: pairs of one angle.";
  if (data.inversion) {
    text +=
        fmt::format(" Strong line: pairs that give the measured {}°, shaded the 95 % band (all at e = {}).",
                    number(data.inversion->question.angle, 4), number(data.inversion->e));
    if (data.inversion->solution) text += " Black: the solution with its interval.";
  }
  return typeset(text);
}

std::string answer_section(const ReportData& data, const Charts& charts) {
  std::string words;
  if (data.inversion) {
    words += headline(*data.inversion);
    for (const std::string& paragraph : answer_paragraphs(*data.law, *data.inversion, data.source)) {
      words += paragraph.starts_with(kCommand) ? "<code>" + escaped(paragraph.substr(2)) + "</code>"
                                               : "<p>" + typeset(paragraph) + "</p>";
    }
  }
  for (const std::string& reason : {data.law_reason, data.inversion_reason}) {
    if (!reason.empty()) words += "<p class=\"note\">" + typeset(reason) + "</p>";
  }
  if (words.empty())
    words = "<p>No measured angle was given: the page shows the equation and the runs alone.</p>";
  if (charts.friction.empty()) return card(words);
  return "<div class=\"two\">" + card(words) +
         card(figure(charts.friction, "Friction values and the measured angle", friction_caption(data))) +
         "</div>";
}

std::string parameter_table(const fit::PowerLaw& law) {
  static constexpr std::array<const char*, 4> kNames = {"<i>C</i> [°]", "exponent of <i>e</i>",
                                                        "exponent of <i>μ</i><sub>r</sub>",
                                                        "exponent of <i>μ</i><sub>s</sub>"};
  std::string rows;
  const auto parameters = law.parameters();
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const fit::Estimate& p = *parameters[i];
    rows += p.identified ? fmt::format(
                               "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">± {}</td>"
                               "<td class=\"number\">{}</td></tr>",
                               kNames[i], like_error(p.value, p.standard_error),
                               like_error(p.standard_error, p.standard_error),
                               like_error(p.interval_95.low, p.standard_error) + " … " +
                                   like_error(p.interval_95.high, p.standard_error))
                         : fmt::format(
                               "<tr><td>{}</td><td colspan=\"3\" class=\"soft\">not found: the factor stands "
                               "still</td></tr>",
                               kNames[i]);
  }
  return "<table><tr><th></th><th class=\"number\">value</th><th class=\"number\">standard error</th>"
         "<th class=\"number\">95 %</th></tr>" +
         rows + "</table>";
}

std::string facts_table(const std::vector<Fact>& facts) {
  std::string rows;
  for (const Fact& fact : facts) {
    rows += "<tr><td>" + typeset(fact.name) + "</td><td>" + typeset(fact.value) + "</td></tr>";
  }
  return "<table class=\"facts\">" + rows + "</table>";
}

std::string quality_table(const fit::PowerLaw& law) {
  const fit::Observation& worst = law.worst_point;
  std::vector<Fact> facts = {
      {"worst error", fmt::format("{}° at e = {}, μs = {}, μr = {}", number(law.worst_error), number(worst.e),
                                  number(worst.mu_s), number(worst.mu_r))},
      {"root mean square error", number(law.rms_error) + "°"},
      {"R²", number(law.r_squared, 4)},
      {"runs fitted",
       fmt::format("{} at {} points, {} left out", law.points, law.distinct_points, law.excluded.size())},
      {"fitted by", law.loss == fit::Loss::minimax ? "smallest worst error" : "least squares, in degrees"}};
  if (std::isfinite(law.error.pure_error)) {
    facts.push_back({"scatter of repeats", number(law.error.pure_error, 2) + "°"});
  }
  facts.push_back({"holds for", fmt::format("e {}, μs {}, μr {}", range(law.domain.e), range(law.domain.mu_s),
                                            range(law.domain.mu_r))});
  return facts_table(facts);
}

std::string equation_section(const ReportData& data, const Charts& charts) {
  const fit::PowerLaw& law = *data.law;
  std::string left = "<p class=\"equation\">" + typeset(equation_in_words(law)) +
                     "<span class=\"soft\" style=\"font-size:17px\"> degrees</span></p>";
  left += parameter_table(law) + "<div style=\"height:18px\"></div>" + quality_table(law);
  for (const std::string& remark : law.remarks) {
    left += "<p class=\"note\" style=\"margin-top:14px\">" + typeset(remark) + "</p>";
  }
  std::string section = "<h2>The equation</h2>\n";
  if (charts.predicted.empty()) return section + card(left);
  const std::string caption = fmt::format(
      "One circle a run. Full line: agreement; shaded: the worst error, ± {}°; ring: where it is.",
      number(law.worst_error));
  return section + "<div class=\"two\">" + card(left) +
         card(figure(charts.predicted, "Angle of the equation against simulated angle", caption)) + "</div>";
}

std::string heaps_section(const ReportData& data) {
  if (data.heaps.empty()) return {};
  std::string cards;
  for (const Picture& heap : data.heaps)
    cards += card(figure(heap.file, heap.caption, typeset(heap.caption)));
  return "<h2>Heaps</h2>\n<div class=\"heaps\">" + cards + "</div>";
}

/// Runs that are in the equation, but worth less than they look.
std::string warnings_section(const ReportData& data) {
  if (data.warnings.empty()) return {};
  std::string rows;
  for (const WarningRow& warning : data.warnings)
    rows += fmt::format("<tr><td>{}</td><td class=\"number\">{}</td><td>{}</td></tr>\n",
                        escaped(warning.name), warning.runs, typeset(warning.example));
  return "<h2>Warnings</h2>\n" +
         card(
             "<table><tr><th>warning</th><th class=\"number\">runs</th><th>in the first of them</th></tr>\n" +
             rows + "</table>");
}

std::string run_row(const RunRow& run, const ReportData& data,
                    const std::map<std::string, std::string>& reasons) {
  const fit::Observation& row = run.observation;
  const auto reason = reasons.find(key_of(row));
  const bool used = data.law && reason == reasons.end();
  const double predicted = used ? data.law->predict(fit::factors_of(row)) : 0.0;
  std::string why = reason != reasons.end() ? reason->second : row.exclusion;
  std::string outcome = why.empty()                    ? run.outcome
                        : why.starts_with(run.outcome) ? why
                                                       : run.outcome + "; " + why;
  if (!run.warnings.empty()) outcome += "; warnings: " + run.warnings;
  const bool has_angle = std::isfinite(row.angle) && row.angle > 0.0;
  std::string angle = has_angle ? fmt::format("{:.2f}", row.angle) : "–";
  if (has_angle && row.standard_error > 0.0) angle += fmt::format(" ± {:.2f}", row.standard_error);
  return fmt::format(
      "<tr{}><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td class=\"number\">{}</td></tr>\n",
      why.empty() ? "" : " class=\"left-out\"", escaped(row.label), number(row.e), number(row.mu_s),
      number(row.mu_r), escaped(outcome), angle, used ? fmt::format("{:.2f}", predicted) : "–",
      used ? with_minus(fmt::format("{:+.2f}", predicted - row.angle)) : "–",
      run.cpu ? fmt::format("{:.1f}", *run.cpu) : "–");
}

std::string runs_section(const ReportData& data) {
  if (data.runs.empty()) return {};
  const auto reasons = reasons_of(data);
  std::string rows;
  for (const RunRow& run : data.runs) rows += run_row(run, data, reasons);
  const std::string table =
      "<div class=\"scroll\"><table><tr><th>run</th><th class=\"number\"><i>e</i></th>"
      "<th class=\"number\"><i>μ</i><sub>s</sub></th><th class=\"number\"><i>μ</i><sub>r</sub></th>"
      "<th>outcome</th><th class=\"number\">angle [°]</th><th class=\"number\">equation [°]</th>"
      "<th class=\"number\">error [°]</th><th class=\"number\">CPU [s]</th></tr>\n" +
      rows + "</table></div>";
  const std::string edge = data.edge.empty() ? "" : "<p>" + typeset(data.edge) + "</p>";
  return "<h2>Runs</h2>\n" +
         card(edge + (data.runs.size() <= kOpenRows
                          ? table
                          : fmt::format("<details><summary>all {} runs</summary>{}</details>",
                                        data.runs.size(), table)));
}

std::string facts_section(const ReportData& data) {
  std::string cards;
  for (const FactGroup& group : data.inputs) {
    if (!group.facts.empty())
      cards += card("<h3>" + escaped(group.heading) + "</h3>" + facts_table(group.facts));
  }
  std::string section;
  if (!cards.empty()) section = "<h2>What was simulated</h2>\n<div class=\"two\">" + cards + "</div>";
  if (!data.cost.empty()) section += "<h2>Cost</h2>\n" + card(facts_table(data.cost));
  return section;
}

}  // namespace

std::vector<fit::Observation> used_rows(const ReportData& data) {
  std::vector<fit::Observation> used;
  if (!data.law) return used;
  const auto reasons = reasons_of(data);
  for (const RunRow& run : data.runs) {
    if (reasons.find(key_of(run.observation)) == reasons.end()) used.push_back(run.observation);
  }
  return used;
}

std::string page_of(const ReportData& data, const Charts& charts) {
  const std::string title = escaped(data.title.empty() ? "Calibration" : data.title);
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<main>\n";
  page += "<header><h1>" + title +
          "</h1><p class=\"soft\">Friction of particles from the angle of repose</p></header>\n";
  page += answer_section(data, charts);
  if (data.law) page += equation_section(data, charts);
  page += heaps_section(data) + warnings_section(data) + runs_section(data) + facts_section(data);
  if (!data.made_by.empty()) page += "<footer>" + escaped(data.made_by) + "</footer>\n";
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace repose::report
