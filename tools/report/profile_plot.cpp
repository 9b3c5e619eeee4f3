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

}  // namespace repose
