#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/vec3.hpp"
#include "engine/scene/sections.hpp"
#include "engine/scene/units.hpp"

namespace repose {

namespace {

/// Printed tables are rounded: 44.44 + 25 + 22.22 + 8.33 = 99.99 (article Table 3).
constexpr double kPercentTolerance = 0.1;

/// One class as it stands in the case.
struct RawClass {
  std::string pointer;
  std::optional<double> volume_min;  ///< [m³]
  std::optional<double> volume_max;
  std::optional<double> percent;
  bool by_volume = false;  ///< volume_mm3 is given
  bool by_mass = false;    ///< mass_percent is given
};

void read_volume_range(CheckedCase& checked, RawClass& raw) {
  const std::string range = raw.pointer + "/volume_mm3";
  if (checked.entries(range) == 0) return;
  const std::optional<double> low = checked.number(range + "/0");
  const std::optional<double> high = checked.number(range + "/1");
  if (!low || !high) return;
  if (*low > *high) return checked.fault(range, "the smaller volume must come first");
  raw.volume_min = from_mm3(*low);
  raw.volume_max = from_mm3(*high);
}

void read_diameter(CheckedCase& checked, RawClass& raw) {
  const std::optional<double> diameter = checked.number(raw.pointer + "/diameter_mm");
  if (!diameter) return;
  const double metres = from_mm(*diameter);
  raw.volume_min = raw.volume_max = kPi / 6.0 * metres * metres * metres;
}

RawClass read_class(CheckedCase& checked, std::size_t index) {
  RawClass raw;
  raw.pointer = fmt::format("{}/{}", kClasses, index);
  const std::string volume = raw.pointer + "/volume_mm3";
  const std::string diameter = raw.pointer + "/diameter_mm";
  const std::string percent = raw.pointer + "/percent";
  const std::string mass_percent = raw.pointer + "/mass_percent";
  raw.by_volume = checked.given(volume);
  raw.by_mass = checked.given(mass_percent);
  if (raw.by_volume == checked.given(diameter))
    checked.fault(raw.pointer, "must give either volume_mm3 or diameter_mm");
  else if (raw.by_volume)
    read_volume_range(checked, raw);
  else
    read_diameter(checked, raw);
  if (raw.by_mass == checked.given(percent))
    checked.fault(raw.pointer, "must give either percent or mass_percent");
  else if (raw.by_mass && raw.by_volume)
    checked.fault(mass_percent, "goes with diameter_mm only; the share of a range of volumes is percent");
  raw.percent = checked.number(raw.by_mass ? mass_percent : percent);
  return raw;
}

/// The classes must be of one kind and their shares whole.
void check_together(CheckedCase& checked, const std::vector<RawClass>& classes) {
  const auto differs = [&](bool RawClass::*kind) {
    return std::ranges::any_of(classes, [&](const RawClass& raw) { return raw.*kind != classes[0].*kind; });
  };
  if (differs(&RawClass::by_volume))
    checked.fault(kClasses, "volume_mm3 and diameter_mm cannot be mixed");
  else if (differs(&RawClass::by_mass))
    checked.fault(kClasses, "percent and mass_percent cannot be mixed");
  double sum = 0.0;
  for (const RawClass& raw : classes) {
    if (!raw.percent) return;
    sum += *raw.percent;
  }
  if (!(std::abs(sum - 100.0) <= kPercentTolerance))
    checked.fault(kClasses, fmt::format("the percentages must sum to 100 within {}, not to {:.6g}",
                                        kPercentTolerance, sum));
}

}  // namespace

std::vector<SizeClass> read_size_classes(CheckedCase& checked) {
  const std::size_t faults_before = checked.fault_count();
  std::vector<RawClass> raw_classes;
  for (std::size_t i = 0; i < checked.entries(kClasses); ++i) {
    if (checked.is_sound(fmt::format("{}/{}", kClasses, i))) raw_classes.push_back(read_class(checked, i));
  }
  if (raw_classes.size() != checked.entries(kClasses) || raw_classes.empty()) return {};
  check_together(checked, raw_classes);
  if (checked.fault_count() != faults_before) return {};

  std::vector<SizeClass> classes;
  double total = 0.0;
  for (const RawClass& raw : raw_classes) {
    if (!raw.percent || !raw.volume_min || !raw.volume_max) return {};
    // n ~ p / (ρ V): a share by mass becomes a share by number; the density is the same for all
    const double share = raw.by_mass ? *raw.percent / *raw.volume_min : *raw.percent;
    if (share == 0.0) continue;  // nothing of it is poured
    total += share;
    classes.push_back({*raw.volume_min, *raw.volume_max, share});
  }
  for (SizeClass& size : classes) size.number_fraction /= total;
  return classes;
}

}  // namespace repose
