#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/process.hpp"
#include "tools/report/report_html.hpp"
#include "tools/report/study_report.hpp"

namespace repose::report::test {

using repose::test::TemporaryFolder;

/// Factorials of the article's equation with a small error that is the same on every call; `e` held at 0.3
/// for a single value, μr at 0.1 likewise.
inline std::vector<fit::Observation> table(const std::vector<double>& e_values,
                                           const std::vector<double>& mu_r_values) {
  std::vector<fit::Observation> rows;
  for (const double e : e_values) {
    for (const double mu_s : {0.2, 0.4, 0.6, 0.8}) {
      for (const double mu_r : mu_r_values) {
        const double error = 0.4 * std::sin(7.0 * static_cast<double>(rows.size()));
        rows.push_back(
            {.e = e,
             .mu_s = mu_s,
             .mu_r = mu_r,
             .angle = 56.61 * std::pow(e, 0.01) * std::pow(mu_r, 0.084) * std::pow(mu_s, 0.25) + error,
             .label = "run " + std::to_string(rows.size() + 1)});
      }
    }
  }
  return rows;
}

inline ReportData report_of(const std::vector<fit::Observation>& rows) {
  ReportData data;
  data.title = "Iron ore";
  data.source = "study";
  for (const fit::Observation& row : rows)
    data.runs.push_back({row, row.exclusion.empty() ? "completed" : "no_heap", 1.5});
  data.law = fit::fit_power_law(rows);
  return data;
}

inline ReportData full_report() { return report_of(table({0.1, 0.3, 0.5}, {0.05, 0.1, 0.2})); }

/// How often a text stands in another.
inline int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace repose::report::test
