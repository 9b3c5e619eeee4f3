#include "engine/measure/heap_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/measure/flank_reader.hpp"
#include "engine/measure/heap_bodies.hpp"
#include "engine/measure/surface.hpp"

namespace repose {

namespace {

constexpr int kLeastBodies = 20;
constexpr double kLayers = 1.6;     // a heap is higher than this, in diameters
constexpr double kLeastFall = 0.5;  // of a surface over its window, in diameters
// Of the tops that a line is fitted to, in the outer half of its window. 18 heaps of cases/quick.json have
// 0.58 to 0.67, 38 of random cases 0.44 and more but for one of 68 degrees (0.26), columns that kept standing
// 0 to 0.06.
constexpr double kLeastOuter = 0.3;
constexpr double kSteepest = radians(60.0);
// A cone of 30° that is four diameters high (below, kFlatHeight flags it) holds 230 bodies at a solid
// fraction of 0.6.
constexpr int kFewBodies = 200;
// Standard error of an angle that is worth giving: with more, its 95 % interval (± 2.07 σ) is wider than 20°,
// more than μs and μr move the angle over the article's ranges (23° to 40°). 3° refused one of 18 heaps of
// about 700 bodies, at 3.5°: an angle with its error serves a fit better than a gap.
constexpr double kWidestError = radians(5.0);
constexpr std::array<const char*, 4> kFlankNames{"+x", "-x", "+y", "-y"};

double quantile(std::vector<double> values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

HeapOutline outline_of(const HeapSnapshot& heap, const std::vector<int>& members,
                       const std::vector<SurfaceTop>& surface) {
  HeapOutline outline;
  std::vector<double> diameters;
  for (const SurfaceTop& top : surface) {
    outline.height = std::max(outline.height, top.z);
    diameters.push_back(top.diameter);
  }
  outline.diameter = quantile(diameters, 0.5);
  outline.bodies = members.size();
  // The axis of the upper half, which strays and a cut foot do not move.
  double volume = 0.0;
  for (const int b : members) {
    const BodySnapshot& body = heap.bodies[static_cast<std::size_t>(b)];
    if (body.position.z() < 0.5 * outline.height) continue;
    outline.x0 += body.volume * body.position.x();
    outline.y0 += body.volume * body.position.y();
    volume += body.volume;
  }
  if (volume > 0.0) {
    outline.x0 /= volume;
    outline.y0 /= volume;
  }
  std::vector<double> radii;
  radii.reserve(surface.size());
  for (const SurfaceTop& top : surface) radii.push_back(std::hypot(top.x - outline.x0, top.y - outline.y0));
  outline.radius = std::max(quantile(radii, 0.95), outline.diameter);
  outline.edge_radius = heap.base_radius - outline.diameter;
  return outline;
}

/// Why what lies there is no heap, or nothing.
std::string no_heap_reason(const std::vector<int>& over, const std::vector<int>& members,
                           const std::vector<SurfaceTop>& surface, double peak) {
  if (over.empty()) return "no heap: nothing rests on the base";
  if (static_cast<int>(members.size()) < kLeastBodies) {
    return fmt::format("no heap: only {} bodies lie together, a heap has at least {}", members.size(),
                       kLeastBodies);
  }
  std::vector<double> diameters;
  diameters.reserve(surface.size());
  for (const SurfaceTop& top : surface) diameters.push_back(top.diameter);
  const double large = quantile(diameters, 0.9);
  if (peak < kLayers * large) {
    return fmt::format("no heap: the bodies lie in one layer, {:.1f} mm high with diameters of {:.1f} mm",
                       1e3 * peak, 1e3 * large);
  }
  return {};
}

std::string unreadable_reason(const FlankReading& reading) {
  std::array<int, 4> count{};
  for (const FlankPoint& p : reading.points) ++count[static_cast<std::size_t>(p.flank)];
  const auto least = static_cast<std::size_t>(std::min_element(count.begin(), count.end()) - count.begin());
  return fmt::format(
      "no heap that can be read: flank {} has {} tops in its window, at least {} are needed; pour more",
      kFlankNames[least], count[least], kLeastTops);
}

std::vector<Warning> warnings_of(const HeapMeasurement& measured, const HeapOutline& outline) {
  std::vector<Warning> warnings;
  const double error = degrees(measured.standard_error);
  if (outline.height < kFlatHeight * outline.diameter)
    warnings.push_back(
        {"flat_heap", fmt::format("the heap is only {:.1f} body diameters high, so that its flanks are "
                                  "read in a window of radius, and to ± {:.1f} degrees; pour more",
                                  outline.height / outline.diameter, error)});
  if (static_cast<int>(outline.bodies) < kFewBodies)
    warnings.push_back(
        {"few_particles",
         fmt::format("the heap holds {} bodies: its angle stands to ± {:.1f} degrees only; pour more, "
                     "or average over seeds",
                     outline.bodies, error)});
  if (measured.angle > kSteepest)
    warnings.push_back(
        {"steep_flanks",
         fmt::format("flanks of {:.0f} degrees: the column may still stand; look at the heap, and open "
                     "faster or wider",
                     degrees(measured.angle))});
  return warnings;
}

bool reaches_edge(const HeapMeasurement& measured, const HeapOutline& outline) {
  double foot = 0.0;
  for (const Flank& flank : measured.flanks) foot += 0.25 * flank.z0 / std::tan(flank.angle);
  return foot >= outline.edge_radius;
}

/// Reach of a flank's window along its direction.
void set_window(Flank& flank, std::size_t f, const FlankReading& reading) {
  double most = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const FlankPoint& p : reading.points) {
    if (static_cast<std::size_t>(p.flank) != f) continue;
    const double r = reading.lines.reduced_radius(p);
    most = std::max(most, r);
    least = std::min(least, r);
  }
  flank.r_begin = least;
  flank.r_end = most;
}

void fill_flanks(HeapMeasurement& measured, const FlankReading& reading,
                 const std::vector<SurfaceTop>& surface) {
  const AngleErrors errors = angle_errors(reading);
  measured.angle = 0.0;
  for (std::size_t f = 0; f < 4; ++f) {
    Flank& flank = measured.flanks[f];
    flank.angle = std::atan(reading.lines.slope[f]);
    flank.standard_error = errors.flank[f];
    flank.z0 = reading.lines.z0[f];
    set_window(flank, f, reading);
    measured.angle += 0.25 * flank.angle;
  }
  measured.standard_error = errors.mean;
  measured.axis_x = reading.x0;
  measured.axis_y = reading.y0;
  for (const SurfaceTop& top : surface) {
    const FlankPoint p = flank_point(top, reading.x0, reading.y0);
    measured.flanks[static_cast<std::size_t>(p.flank)].profile.push_back(
        {reading.lines.reduced_radius(p), top.z});
  }
}

/// How far the surface falls over the window, the mean of the four flanks.
double mean_fall(const HeapMeasurement& measured) {
  double fall = 0.0;
  for (const Flank& flank : measured.flanks)
    fall += 0.25 * std::tan(flank.angle) * (flank.r_end - flank.r_begin);
  return fall;
}

/// Why the lines found are no slope, or nothing.
std::string level_reason(const HeapMeasurement& measured, const HeapOutline& outline) {
  const double fall = mean_fall(measured) / outline.diameter;
  if (fall >= kLeastFall) return {};
  return fmt::format("no heap: the surface is level, it falls by {:.1f} body diameters", fall);
}

/// Of the tops that the lines were fitted to, the share in the outer half of the stretch over which each line
/// crosses the window, or ends at the base's edge. Tops lie evenly over the ground, so that of a slope it is
/// more than a half; where only the top of a column that still stands was read, its sides, nearly without
/// tops, take the place of the outer half.
double outer_share(const HeapOutline& outline, const FlankReading& reading) {
  const FlankWindow& window = reading.window;
  int outer = 0;
  for (const FlankPoint& p : reading.points) {
    const auto f = static_cast<std::size_t>(p.flank);
    const double z0 = reading.lines.z0[f], slope = reading.lines.slope[f];
    const double begin = std::max(0.0, (z0 - window.high) / slope);
    const double end = std::min((z0 - std::max(window.low, window.lowest)) / slope, outline.edge_radius);
    if (reading.lines.reduced_radius(p) > 0.5 * (begin + end)) ++outer;
  }
  return static_cast<double>(outer) / static_cast<double>(reading.points.size());
}

/// Why they are the lines of a top alone, or nothing.
std::string standing_reason(const HeapMeasurement& measured, const HeapOutline& outline,
                            const FlankReading& reading) {
  if (reading.window.in_radius) return {};
  if (outer_share(outline, reading) >= kLeastOuter) return {};
  return fmt::format(
      "no heap that can be read: its top falls by {:.0f} degrees, and below it no slope goes on: the "
      "column may still stand; look at the heap, and open faster or wider",
      degrees(measured.angle));
}

/// Why they are no angle that is worth giving, or nothing.
std::string uncertain_reason(const HeapMeasurement& measured, const HeapOutline& outline) {
  if (measured.standard_error <= kWidestError) return {};
  return fmt::format(
      "no heap that can be read: {} bodies leave the angle uncertain by {:.1f} degrees (bar: {:.0f}); "
      "pour more",
      outline.bodies, degrees(measured.standard_error), degrees(kWidestError));
}

}  // namespace

HeapMeasurement measure_heap(const HeapSnapshot& heap, const MeasureOptions& options) {
  HeapMeasurement measured;
  if (!is_finite(heap)) {
    measured.reason = "no heap: a body's position, mass or volume is not a finite number";
    return measured;
  }
  const std::vector<int> over = bodies_over_base(heap);
  for (const int b : over) measured.mass_on_base += heap.bodies[static_cast<std::size_t>(b)].mass;
  const std::vector<int> members = largest_cluster(heap, over);
  const std::vector<SurfaceTop> surface = free_surface(heap, members);
  for (const SurfaceTop& top : surface) measured.peak_height = std::max(measured.peak_height, top.z);
  measured.reason = no_heap_reason(over, members, surface, measured.peak_height);
  if (!measured.reason.empty()) return measured;

  const HeapOutline outline = outline_of(heap, members, surface);
  const FlankReading reading = read_flanks(surface, outline, options);
  if (!reading.readable) {
    measured.reason = unreadable_reason(reading);
    measured.unreadable = true;
    return measured;
  }
  fill_flanks(measured, reading, surface);
  measured.reason = level_reason(measured, outline);
  if (!measured.reason.empty()) return measured;
  measured.reason = standing_reason(measured, outline, reading);
  if (measured.reason.empty()) measured.reason = uncertain_reason(measured, outline);
  measured.unreadable = !measured.reason.empty();
  if (measured.unreadable) return measured;
  measured.has_heap = true;
  measured.reaches_edge = reaches_edge(measured, outline);
  measured.warnings = warnings_of(measured, outline);
  return measured;
}

}  // namespace repose
