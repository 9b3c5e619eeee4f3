#include "verification/table/oblique_tests.hpp"
#include "verification/table/plot.hpp"

namespace repose::verification {

namespace {

constexpr int kCurvePoints = 150;

/// The engine's points over the quadrature, drawn densely, and the closed form where it holds.
Plot plot_of(const ObliqueTest& test) {
  Plot plot{test.file, test.name, test.x_label, test.y_label, false, {}};
  Series curve{"quadrature", Series::Look::line, {}, {}}, closed{"closed form", Series::Look::dashes, {}, {}},
      engine{"engine", Series::Look::points, {}, {}};
  for (int k = 0; k <= kCurvePoints; ++k) {
    const double part = static_cast<double>(k) / kCurvePoints;
    const double x = test.points.front() + part * (test.points.back() - test.points.front());
    curve.x.push_back(x);
    curve.y.push_back(test.y(quadrature_outcome(test.impact(x))));
    if (const auto theory = test.closed(x)) {
      closed.x.push_back(x);
      closed.y.push_back(*theory);
    }
  }
  for (const double x : test.points) {
    engine.x.push_back(x);
    engine.y.push_back(test.y(engine_outcome(test.impact(x))));
  }
  plot.series = {curve, engine};
  if (!closed.x.empty()) plot.series.insert(plot.series.begin() + 1, closed);
  return plot;
}

}  // namespace

std::vector<Plot> oblique_plots() {
  std::vector<Plot> plots;
  for (const ObliqueTest& test : oblique_tests()) plots.push_back(plot_of(test));
  return plots;
}

}  // namespace repose::verification
