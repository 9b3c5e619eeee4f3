#include <fmt/format.h>

#include "engine/scene/particle_sizes.hpp"
#include "engine/scene/sections.hpp"
#include "engine/scene/units.hpp"

namespace repose {

Numerics read_numerics(CheckedCase& checked) {
  const std::string fraction = "/numerics/time_step_fraction";
  const std::string step = "/numerics/time_step_s";
  Numerics numerics;
  if (checked.given(fraction) && checked.given(step))
    checked.fault(step, "excludes " + fraction + ": give one of the two");
  if (checked.given(step)) {
    numerics.time_step = checked.number(step);
    numerics.time_step_fraction.reset();
  } else if (checked.given(fraction)) {
    numerics.time_step_fraction = checked.number(fraction);  // nothing for "auto"
  }
  numerics.stiffness_scale = checked.number_or("/numerics/stiffness_scale", numerics.stiffness_scale);
  numerics.integrator = checked.choice_or("/numerics/integrator", numerics.integrator);
  numerics.arithmetic = checked.choice_or("/numerics/arithmetic", numerics.arithmetic);
  numerics.settle_energy_ratio =
      checked.number_or("/numerics/settle_energy_ratio", numerics.settle_energy_ratio);
  numerics.rest_energy_ratio = checked.number_or("/numerics/rest_energy_ratio", numerics.rest_energy_ratio);
  if (const auto change = checked.number("/numerics/rest_angle_change_deg"))
    numerics.rest_angle_change = radians(*change);
  numerics.stage_time_limit = checked.number_or("/numerics/stage_time_limit_s", numerics.stage_time_limit);
  return numerics;
}

/// Products of moments of inertia, and squares of forces, leave the range of single precision (1e-38) with
/// smaller particles: two spheres of this radius and 100 kg/m³ have I² = 3e-36. The contacts that the law is
/// tested on (tests/unit/contact) begin here too.
constexpr double kSmallestSingle = 1e-4;  // radius [m]

void check_arithmetic(CheckedCase& checked, const Particles& particles, Arithmetic arithmetic) {
  if (arithmetic != Arithmetic::mixed || particles.shapes.empty()) return;
  const double radius = smallest_sphere(particles);
  if (!(radius >= kSmallestSingle))
    checked.fault("/numerics/arithmetic",
                  fmt::format("needs spheres of {} mm radius at least; the smallest has {:.3g} mm",
                              to_mm(kSmallestSingle), to_mm(radius)));
}

MeasureOptions read_measure(CheckedCase& checked) {
  const std::string window = "/measure/window";
  MeasureOptions measure;
  if (checked.entries(window) == 0) return measure;
  const std::optional<double> low = checked.number(window + "/0");
  const std::optional<double> high = checked.number(window + "/1");
  if (low && high && *low >= *high) checked.fault(window, "the lower end must be below the upper end");
  measure.window_low = low.value_or(measure.window_low);
  measure.window_high = high.value_or(measure.window_high);
  return measure;
}

}  // namespace repose
