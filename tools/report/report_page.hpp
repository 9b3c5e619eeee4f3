#pragma once

#include <filesystem>
#include <string>

#include "tools/report/study_report.hpp"

namespace repose::report {

/// Charts of the page; empty paths where there is nothing to draw.
struct Charts {
  std::filesystem::path friction;
  std::filesystem::path predicted;
};

/// The page as HTML, pictures inside. All texts of the data are escaped.
std::string page_of(const ReportData& data, const Charts& charts);

/// The rows of the table that the law was fitted to.
std::vector<fit::Observation> used_rows(const ReportData& data);

}  // namespace repose::report
