#include "tools/report/profile_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tools/plot/gnuplot.hpp"

namespace repose {

namespace {

constexpr double kMm = 1e3;

struct PanelAxes {
  double reach = 0.0;  ///< half width [mm]
  double height = 0.0;
};

PanelAxes axes_of(const HeapMeasurement& measurement) {
  PanelAxes axes;
  for (const Flank& flank : measurement.flanks)
    for (const ProfilePoint& point : flank.profile) {
      axes.reach = std::max(axes.reach, kMm * std::abs(point.r));
      axes.height = std::max(axes.height, kMm * point.z);
    }
  return {1.05 * std::max(axes.reach, 1.0), 1.25 * std::max(axes.height, 1.0)};
}

/// Data blocks of one panel: tops and line of the flank along +axis, then of the one along −axis.
std::string panel(const Flank& plus, const Flank& minus, const char* axis, const PanelAxes& axes) {
  std::string script;
  auto out = std::back_inserter(script);
  const auto flank_data = [&](const Flank& flank, double sign, const char* name) {
    fmt::format_to(out, "${}{} << EOD\n", name, axis);
    for (const ProfilePoint& point : flank.profile)
      fmt::format_to(out, "{:.4f} {:.4f}\n", sign * kMm * point.r, kMm * point.z);
    fmt::format_to(out, "EOD\n${}line{} << EOD\n", name, axis);
    for (const double r : {flank.r_begin, flank.r_end})
      fmt::format_to(out, "{:.4f} {:.4f}\n", sign * kMm * r, kMm * (flank.z0 - std::tan(flank.angle) * r));
    fmt::format_to(out, "EOD\n");
  };
  flank_data(plus, 1.0, "plus");
  flank_data(minus, -1.0, "minus");
  const auto label = [&](const Flank& flank, double sign, int number) {
    fmt::format_to(
        out,
        "set label {} sprintf('%.1f° ± %.1f°', {:.4f}, {:.4f}) at {:.4f},{:.4f} center tc rgb '#b5532a'\n",
        number, degrees(flank.angle), degrees(flank.standard_error), sign * 0.62 * axes.reach,
        0.9 * axes.height);
  };
  label(plus, 1.0, 1);
  label(minus, -1.0, 2);
  fmt::format_to(
      out,
      "set xlabel 'distance from the base''s axis along {0} / mm'\n"
      "plot $plus{0} with points pt 7 ps 0.45 lc rgb '#7a8793', $minus{0} with points pt 7 ps 0.45 lc rgb "
      "'#7a8793', "
      "$plusline{0} with lines lw 3 lc rgb '#b5532a', $minusline{0} with lines lw 3 lc rgb '#b5532a'\n",
      axis);
  return script;
}

/// A sphere on the picture plane.
struct Disc {
  double u, v, radius, depth;
  int shade;
};

/// Seen from direction (cos A cos E, sin A cos E, sin E).
struct View {
  double azimuth = radians(35.0), elevation = radians(18.0);
  [[nodiscard]] Disc project(const Vec3& p, double radius, int shade) const {
    const double toward = p.x() * std::cos(azimuth) + p.y() * std::sin(azimuth);
    return {kMm * (p.y() * std::cos(azimuth) - p.x() * std::sin(azimuth)),
            kMm * (p.z() * std::cos(elevation) - toward * std::sin(elevation)), kMm * radius,
            toward * std::cos(elevation) + p.z() * std::sin(elevation), shade};
  }
};

/// Rock colours, by body, so that the spheres of one particle belong together.
int rock_colour(int body, double light) {
  const int variation = static_cast<int>((static_cast<unsigned>(body) * 2654435761U) >> 26U);  // 0 … 63
  const auto channel = [&](int base) {
    return std::clamp(static_cast<int>(light * (base + 0.6 * (variation - 32))), 0, 255);
  };
  return channel(150) << 16 | channel(112) << 8 | channel(92);
}

}  // namespace

void plot_profiles(const HeapMeasurement& measurement, const std::filesystem::path& png,
                   const std::string& title) {
  const PanelAxes axes = axes_of(measurement);
  const std::string result =
      measurement.has_heap ? fmt::format("angle of repose {:.2f}° ± {:.2f}°", degrees(measurement.angle),
                                         degrees(measurement.standard_error))
                           : "no heap: " + measurement.reason;
  run_gnuplot(fmt::format(
      "set encoding utf8\n"
      "set terminal pngcairo size 1100,820 enhanced font 'Sans,13' background '#ffffff'\n"
      "set output '{}'\n"
      "set border 3 lw 1 lc rgb '#a3adb8'\nset tics nomirror out scale 0.5 tc rgb '#22303c'\n"
      "set grid lt 1 lw 0.6 lc rgb '#e6e9ec'\nunset key\n"
      "set xrange [{:.4f}:{:.4f}]\nset yrange [0:{:.4f}]\nset size ratio -1\nset ylabel 'height / mm'\n"
      "set multiplot layout 2,1 title '{}'.\"\\n\".'{}' noenhanced\n{}{}unset multiplot\n",
      gnuplot_quoted(png.string()), -axes.reach, axes.reach, axes.height, gnuplot_quoted(title),
      gnuplot_quoted(result), panel(measurement.flanks[0], measurement.flanks[1], "x", axes),
      panel(measurement.flanks[2], measurement.flanks[3], "y", axes)));
}

void plot_heap(const HeapSnapshot& heap, const std::filesystem::path& png) {
  const View view;
  std::vector<Disc> discs;
  double reach = 0.05, top = 0.02;
  for (const SphereSnapshot& sphere : heap.spheres) {
    discs.push_back(view.project(sphere.centre, sphere.radius, sphere.body));
    reach = std::max({reach, std::abs(sphere.centre.x()), std::abs(sphere.centre.y())});
    top = std::max(top, sphere.centre.z() + sphere.radius);
  }
  if (!std::isinf(heap.base_radius)) reach = 1.02 * heap.base_radius;
  std::sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.depth < b.depth; });

  // Each sphere is a dark disc and, towards the light at the upper left, two smaller brighter ones.
  std::string data = "$spheres << EOD\n";
  auto out = std::back_inserter(data);
  for (const Disc& disc : discs)
    for (const auto& [size, shift, light] :
         {std::array{1.0, 0.0, 0.55}, std::array{0.82, 0.12, 0.9}, std::array{0.5, 0.26, 1.15}})
      fmt::format_to(out, "{:.3f} {:.3f} {:.3f} {}\n", disc.u - shift * disc.radius,
                     disc.v + shift * disc.radius, size * disc.radius, rock_colour(disc.shade, light));
  data += "EOD\n$base << EOD\n";
  const bool bounded = !std::isinf(heap.base_radius);
  for (int k = 0; k <= 180 && bounded; ++k) {
    const double a = 2.0 * kPi * k / 180.0;
    const Disc point =
        view.project({heap.base_radius * std::cos(a), heap.base_radius * std::sin(a), 0.0}, 0.0, 0);
    fmt::format_to(out, "{:.3f} {:.3f}\n", point.u, point.v);
  }
  if (!bounded)
    for (const auto& [x, y] :
         {std::array{-1.1, -1.1}, std::array{1.1, -1.1}, std::array{1.1, 1.1}, std::array{-1.1, 1.1}}) {
      const Disc point = view.project({x * reach, y * reach, 0.0}, 0.0, 0);
      fmt::format_to(out, "{:.3f} {:.3f}\n", point.u, point.v);
    }
  data += "EOD\n";

  const double width = kMm * reach * (bounded ? 1.05 : 1.6);
  const double low = -width * std::sin(view.elevation) * 1.1,
               high = std::max(1.1 * kMm * top * std::cos(view.elevation),
                               1.1 * width * std::sin(view.elevation));
  const int pixels = 1200;
  run_gnuplot(fmt::format(
      "set terminal pngcairo size {},{} background '#ffffff'\nset output '{}'\n{}"
      "unset border\nunset tics\nunset key\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
      "set xrange [{:.3f}:{:.3f}]\nset yrange [{:.3f}:{:.3f}]\nset size ratio -1\n"
      "plot $base with filledcurves closed fc rgb '#dfe4e8', $base with lines lw 1.5 lc rgb '#a3adb8', "
      "$spheres using 1:2:3:4 with circles fill solid noborder lc rgb variable\n",
      pixels, static_cast<int>(pixels * (high - low) / (2.0 * width)), gnuplot_quoted(png.string()), data,
      -width, width, low, high));
}

}  // namespace repose
