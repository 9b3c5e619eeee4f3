#include "verification/table/oblique_tests.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr const char* kObliqueSource = "Chung & Ooi 2011";
constexpr double kObliqueBar = 5e-3;

/// Two rows a test: against the closed form where it holds, and against the quadrature everywhere.
Rows rows_of(const ObliqueTest& test) {
  Worst closed(test.name + ", sliding: " + test.quantity, kObliqueSource, kObliqueBar);
  Worst curve(test.name + ", whole range: " + test.quantity, "quadrature of the contact law", kObliqueBar);
  bool has_closed = false;
  for (const double x : test.points) {
    const Impact impact = test.impact(x);
    const Oblique engine = engine_outcome(impact), quadrature = quadrature_outcome(impact);
    const double scale = test.change(quadrature);
    curve.add(test.y(quadrature), test.y(engine), scale);
    if (const auto theory = test.closed(x)) {
      closed.add(*theory, test.y(engine), scale);
      has_closed = true;
    }
  }
  return has_closed ? Rows{closed.row(), curve.row()} : Rows{curve.row()};
}

/// Test 7: two equal spheres with equal and opposite spins: their surfaces do not move against each other.
Rows equal_spins() {
  Rows rows;
  for (const auto& [name, material] : {std::pair{"aluminium alloy", elastic_material(70e9, 0.33, 2700.0)},
                                       std::pair{"copper", elastic_material(120e9, 0.35, 8900.0)}}) {
    Worst worst(std::string("7: equal and opposite spins, ") + name +
                    ", 0.175–22.86 rad/s: spins kept, no tangential speed, rebound",
                kObliqueSource, kObliqueBar);
    for (const double spin : {0.175, 1.0, 5.0, 10.0, 15.0, 22.86}) {
      Impact impact;
      impact.body = sphere_clump(0.1);
      impact.material = material;
      impact.other = impact.body;
      impact.contact = {0.5, 0.4, 0.0};
      impact.velocity = {0.2, 0.0, 0.0};
      impact.other_velocity = {-0.2, 0.0, 0.0};
      impact.spin = {0.0, 0.0, spin};
      impact.other_spin = {0.0, 0.0, -spin};
      const Impact::Result result = impact.run();
      worst.add(spin, result.spin.z());
      worst.add(-spin, result.other_spin.z());
      for (const Vec3& velocity : {result.velocity, result.other_velocity})
        worst.add(0.0, std::hypot(velocity.y(), velocity.z()), std::min(0.2, spin * 0.1));
      worst.add(-0.1, result.velocity.x());
      worst.add(0.1, result.other_velocity.x());
    }
    rows.push_back(worst.row());
  }
  return rows;
}

}  // namespace

Rows oblique_impact_rows() {
  Rows rows;
  for (const ObliqueTest& test : oblique_tests()) {
    const Rows more = rows_of(test);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const Rows spins = equal_spins();
  rows.insert(rows.end(), spins.begin(), spins.end());
  return rows;
}

}  // namespace repose::verification
