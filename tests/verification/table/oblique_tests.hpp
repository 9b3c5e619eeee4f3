#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/planar_impact.hpp"
#include "verification/table/impact.hpp"

namespace repose::verification {

/// What an oblique impact leaves behind, by whatever way it was found. Speeds are those of the first body (or
/// of its surface) against the other's, along +y.
struct Oblique {
  double incident_tangential = 0.0;  ///< of the centres, before [m/s]
  double incident_slip = 0.0;        ///< of the surfaces, before [m/s]
  double tangential = 0.0;           ///< of the centres [m/s]
  double slip = 0.0;                 ///< of the surfaces [m/s]
  double spin = 0.0;                 ///< of the first body, about z [rad/s]
  double closing = 0.0;              ///< normal speed, negative when they part [m/s]
};

/// One impact by the engine, and by the quadrature, which shares no code with it.
Oblique engine_outcome(const Impact& impact);
Oblique quadrature_outcome(const Impact& impact);

/// One of the oblique tests of Chung & Ooi (2011): a quantity y over x, one impact per x.
struct ObliqueTest {
  std::string name;
  std::string file;      ///< of its plot, without ending
  std::string quantity;  ///< y, for the table
  std::string x_label, y_label;
  std::vector<double> points;  ///< x at which the engine is run
  std::function<Impact(double x)> impact;
  std::function<double(const Oblique&)> y;
  /// What the impact changes y by: errors are held against it. (Against y itself they would have no meaning
  /// where a curve crosses zero; against the incidence they would be small however wrong a small change is.)
  std::function<double(const Oblique&)> change;
  /// y where a closed form holds: the surfaces slide to the end of the contact under a force that never
  /// attracts.
  std::function<std::optional<double>(double x)> closed;
};

/// Tests 4, 5, 6 and 8, with every material.
std::vector<ObliqueTest> oblique_tests();

}  // namespace repose::verification
