#include "tools/report/study_report.hpp"

#include <fstream>
#include <stdexcept>

#include "tools/report/report_charts.hpp"
#include "tools/report/report_page.hpp"

namespace repose::report {

std::filesystem::path write_report(const std::filesystem::path& dir, const ReportData& data) {
  std::filesystem::create_directories(dir);
  Charts charts;
  if (data.law) {
    const std::vector<fit::Observation> used = used_rows(data);
    if (data.law->b.identified || data.law->c.identified) {
      charts.friction = dir / "level_set.svg";
      draw_friction(charts.friction, *data.law, data.inversion, used);
    }
    if (!used.empty()) {
      charts.predicted = dir / "predicted_simulated.svg";
      draw_predicted_against_simulated(charts.predicted, *data.law, used);
    }
  }
  std::filesystem::path file = dir / "report.html";
  std::ofstream stream(file, std::ios::binary);
  stream << page_of(data, charts);
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
  return file;
}

}  // namespace repose::report
