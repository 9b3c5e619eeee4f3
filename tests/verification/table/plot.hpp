#pragma once

#include <string>
#include <vector>

namespace repose::verification {

/// One curve of a plot.
struct Series {
  enum class Look { points, line, dashes };
  std::string name;
  Look look = Look::points;
  std::vector<double> x, y;
};

/// Data of one picture, which the program draws and writes as CSV.
struct Plot {
  std::string file;  ///< without ending
  std::string title;
  std::string x_label, y_label;
  bool logarithmic = false;  ///< both axes
  std::vector<Series> series;
};

std::vector<Plot> oblique_plots();
std::vector<Plot> order_plots();

}  // namespace repose::verification
