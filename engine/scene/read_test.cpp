#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/particle_sizes.hpp"
#include "engine/scene/sections.hpp"
#include "engine/scene/units.hpp"

namespace repose {

namespace {

/// Fewer particles than this across the cylinder arch over it or fall as single bodies: no heap to measure.
constexpr double kParticlesAcross = 3.0;

/// More bodies than this do not fit the memory of a machine that one would run them on; it is a slip of
/// units.
constexpr double kMostParticles = 1e7;

SharedColumns read_shared_columns(const CheckedCase& checked) {
  const std::string section = "/test/shared_columns";
  SharedColumns columns;
  columns.count = checked.integer(section + "/count").value_or(columns.count);
  ContactParameters& contact = columns.contact;
  contact.restitution = checked.number_or(section + "/restitution", contact.restitution);
  contact.static_friction = checked.number_or(section + "/static_friction", contact.static_friction);
  contact.rolling_friction = checked.number_or(section + "/rolling_friction", contact.rolling_friction);
  return columns;
}

}  // namespace

SlumpTest read_test(CheckedCase& checked) {
  SlumpTest test;
  test.kind = checked.choice_or("/test/kind", test.kind);
  test.filling = checked.choice_or("/test/filling", test.filling);
  const std::optional<double> base = checked.number("/test/base/diameter_mm");
  const std::optional<double> cylinder = checked.number("/test/cylinder/diameter_mm");
  if (base) test.base_radius = from_mm(*base) / 2.0;
  if (const auto height = checked.number("/test/base/height_mm")) test.base_height = from_mm(*height);
  if (base && cylinder && *cylinder > *base)
    checked.fault("/test/cylinder/diameter_mm",
                  fmt::format("must stand on the base, whose diameter_mm is {}", *base));
  test.cylinder_radius = from_mm(cylinder.value_or(0.0)) / 2.0;
  test.cylinder_height = from_mm(checked.number_or("/test/cylinder/height_mm", 0.0));
  test.pour_rate = checked.number_or("/test/pour_rate_kg_s", test.pour_rate);
  test.pour_speed = checked.number_or("/test/pour_speed_m_s", test.pour_speed);
  test.opening = checked.choice_or("/test/opening", test.opening);
  test.opening_speed = checked.number_or("/test/opening_speed_m_s", test.opening_speed);
  if (checked.given("/test/shared_columns")) test.shared_columns = read_shared_columns(checked);
  return test;
}

/// A mesh of millimetres that says nothing of it is taken in metres where it is small.
std::string hint_at_units(const CheckedCase& checked) {
  for (std::size_t i = 0; i < checked.entries("/particles/shapes"); ++i) {
    const std::string pointer = fmt::format("/particles/shapes/{}", i);
    if (checked.given(pointer + "/mesh") && !checked.given(pointer + "/unit"))
      return fmt::format(" (is its mesh in mm? {}/unit says so)", pointer);
  }
  return {};
}

void check_fit(CheckedCase& checked, const Particles& particles, const SlumpTest& test) {
  if (particles.shapes.empty()) return;
  const LargestSizes sizes = largest_sizes(particles);
  const double diameter = 2.0 * test.cylinder_radius;
  if (diameter > 0.0 && diameter < sizes.span)
    checked.fault("/test/cylinder/diameter_mm",
                  fmt::format("must hold the largest particle, which spans {:.3g} mm{}", to_mm(sizes.span),
                              hint_at_units(checked)));
  else if (diameter > 0.0 && diameter < kParticlesAcross * sizes.diameter)
    checked.fault("/test/cylinder/diameter_mm",
                  fmt::format("must be at least {} times the largest particle's diameter, {:.3g} mm",
                              kParticlesAcross, to_mm(sizes.diameter)));
  if (test.cylinder_height > 0.0 && test.cylinder_height < sizes.span)
    checked.fault("/test/cylinder/height_mm",
                  fmt::format("must hold the largest particle, which spans {:.3g} mm", to_mm(sizes.span)));

  const double particle = particles.material.density * sizes.mean_volume;
  if (particles.material.density <= 0.0 || particles.total_mass <= 0.0) return;
  if (!std::isnormal(particle))
    return checked.fault("/particles/density_kg_m3", fmt::format("makes particles of {:.3g} kg", particle));
  const double count = particles.total_mass / particle;
  if (count < 1.0)
    checked.fault("/particles/total_mass_kg",
                  fmt::format("must be at least the mass of one particle, {:.3g} kg", particle));
  if (count > kMostParticles)
    checked.fault("/particles/total_mass_kg",
                  fmt::format("makes {:.3g} particles of {:.3g} kg; at most {:.0e} can be simulated", count,
                              particle, kMostParticles));
}

}  // namespace repose
