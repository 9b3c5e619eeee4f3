#include "tools/report/stability_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/scene/names.hpp"
#include "tools/plot/gnuplot.hpp"

namespace repose::report {
namespace {

constexpr std::array kRollingColours{"#b5532a", "#e0a23c", "#2b5f8c", "#5a8f4a", "#8a5a9f", "#22303c"};
constexpr std::array kTestColours{"#8a5a9f", "#b5532a", "#5a8f4a", "#2b5f8c"};
constexpr std::array kTestPoints{6, 5, 8, 7};
constexpr double kLeastError = 1e-5, kMostError = 30.0;  ///< ends of the axis of errors

std::string words_of(StabilityTest test) {
  std::string words(name_of(test));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string title_of(StabilityTest test) {
  switch (test) {
    case StabilityTest::elastic_pair:
      return "An elastic pair";
    case StabilityTest::settled_column:
      return "A settled column";
    case StabilityTest::flat_clump:
      return "A flat clump on a plate";
    case StabilityTest::slump:
      return "The slump, shortened";
  }
  return {};
}

struct Size {
  int width, height;
};

/// Runs a script twice, for both kinds of file.
void draw_both(const std::filesystem::path& file, const Size& size, const std::string& script) {
  for (const bool svg : {true, false})
    run_gnuplot(fmt::format(
        "set terminal {} size {},{} enhanced font '{}' background '#ffffff'\nset output '{}'\nset encoding "
        "utf8\n{}",
        svg ? "svg" : "pngcairo", size.width, size.height, svg ? "Helvetica,14" : "Helvetica,11",
        gnuplot_quoted(file.string() + (svg ? ".svg" : ".png")), script));
}

constexpr const char* kAxes =
    "set border 3 lw 1 lc rgb '#a3adb8'\nset tics nomirror out scale 0.5 tc rgb '#22303c'\n"
    "set grid lt 1 lw 0.6 lc rgb '#e6e9ec'\n"
    "set xtics (0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30)\n";

/// Rows of the case's own stiffness and one experiment.
std::vector<const MapRow*> rows_of(const StabilityMap& map, const Scene& scene, StabilityTest test) {
  std::vector<const MapRow*> rows;
  for (const MapRow& row : map.rows)
    if (row.test == test && row.stiffness_scale == scene.numerics.stiffness_scale) rows.push_back(&row);
  return rows;
}

std::size_t colour_of(const Method& method) {
  const std::vector<Method> all = all_methods();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].rolling_model == method.rolling_model && all[k].rolling_torque == method.rolling_torque)
      return k;
  return kRollingColours.size() - 1;
}

std::string rolling_of(const MapRow& row) {
  return row.any_rolling ? "without friction" : rolling_name(row.method);
}

/// What could not be measured as a number lies at the top of the axis.
double shown_error(const Probe& probe) {
  const bool lost = probe.failure == Failure::escaped || probe.failure == Failure::diverged;
  const double error = std::abs(probe.energy_error);
  return lost || !(error < kMostError) ? kMostError : std::max(error, kLeastError);
}

/// Two blocks of a row: all its probes, and those that failed.
std::string data_of(const MapRow& row, std::size_t number) {
  std::string all, failed;
  for (const Probe& probe : row.cliff.probes) {
    const std::string line =
        fmt::format("{:.6g} {:.6g}\n", probe.step / row.smallest_rayleigh, shown_error(probe));
    all += line;
    if (!probe.stable()) failed += line;
  }
  if (failed.empty()) failed = "1e9 1\n";
  return fmt::format("$all{0} << EOD\n{1}EOD\n$failed{0} << EOD\n{2}EOD\n", number, all, failed);
}

struct Range {
  double low = 1e300, high = 0.0;
  void take(double x) { low = std::min(low, x), high = std::max(high, x); }
};

/// One entry of a legend, drawn as a label with its point: gnuplot keeps a key within the width of a panel.
struct Entry {
  std::string text;
  int point;
  const char* colour;
};

/// Entries side by side, each as wide as its text, in the middle of the picture.
std::string legend(const std::vector<Entry>& entries, double y) {
  constexpr double kCharacter = 0.0085, kBetween = 0.035;
  double width = 0.0;
  for (const Entry& entry : entries) width += kBetween + kCharacter * static_cast<double>(entry.text.size());
  double x = 0.5 - 0.5 * width;
  std::string script;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    script += fmt::format(
        "set label {} '{}' at screen {:.3f},{:.3f} left noenhanced tc rgb '#22303c' point pt {} ps 1.1 lw 2 "
        "lc rgb '{}' offset 1.2,0\n",
        k + 1, gnuplot_quoted(entries[k].text), x, y, entries[k].point, entries[k].colour);
    x += kBetween + kCharacter * static_cast<double>(entries[k].text.size());
  }
  return script;
}

/// One panel: the rows of an integrator.
std::string energy_panel(const std::vector<const MapRow*>& rows, Integrator integrator, bool first,
                         const Tolerance& tolerance) {
  std::string script =
      fmt::format("set title '{}' noenhanced tc rgb '#22303c' offset 0,-0.6\n", choice_name(integrator));
  script += first ? "set ylabel '|energy error|' tc rgb '#22303c' offset 1.5,0\n" : "unset ylabel\n";
  std::string plots = fmt::format("{} with lines lw 1.5 dt (6,4) lc rgb '#7d8894' notitle", tolerance.energy);
  std::size_t number = 0;
  for (const MapRow* row : rows) {
    if (row->method.integrator != integrator || row->cliff.probes.empty()) continue;
    script += data_of(*row, number);
    const char* colour = kRollingColours[colour_of(row->method) % kRollingColours.size()];
    plots += fmt::format(
        ", $all{0} with lines lw 1.8 lc rgb '{1}' notitle, $failed{0} with points pt 2 ps 0.8 lw 1.8 lc rgb "
        "'{1}' notitle",
        number, colour);
    ++number;
  }
  return script + "plot " + plots + "\n";
}

void draw_energy(const std::filesystem::path& file, const std::vector<const MapRow*>& rows,
                 StabilityTest test, const Tolerance& tolerance) {
  Range steps, errors;
  for (const MapRow* row : rows)
    for (const Probe& probe : row->cliff.probes) {
      steps.take(probe.step / row->smallest_rayleigh);
      errors.take(shown_error(probe));
    }
  std::vector<Entry> entries;
  for (const MapRow* row : rows)
    if (row->method.integrator == rows.front()->method.integrator)
      entries.push_back(
          {rolling_of(*row), 5, kRollingColours[colour_of(row->method) % kRollingColours.size()]});
  entries.push_back({"failed", 2, "#5c6975"});
  std::string script = kAxes;
  script += fmt::format(
      "set multiplot layout 1,3 margins 0.075,0.985,0.235,0.83 spacing 0.025,0 title '{{/:Bold {}}}: energy "
      "error against step, × failed, dashed: the bar of {:.3g} %, grey: 30 % of {{/:Italic T}}_R' tc rgb "
      "'#22303c'\n"
      "set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.3g}:{:.3g}]\nset format y "
      "'10^{{%T}}'\nset xlabel 'step / {{/:Italic T}}_R of the smallest sphere' tc rgb '#22303c' offset "
      "0,0.5\nunset key\nset arrow 1 from 0.3,graph 0 to 0.3,graph 1 nohead back lw 5 lc rgb '#dfe3e7'\n",
      title_of(test), 100.0 * tolerance.energy, 0.93 * steps.low, 1.08 * steps.high, 0.7 * errors.low,
      1.6 * kMostError);
  script += legend(entries, 0.05);
  bool first = true;
  for (const auto& integrator : kNames<Integrator>) {
    script += energy_panel(rows, integrator.value, first, tolerance);
    if (first) script += "set format y ''\nunset ylabel\nunset label\n";
    first = false;
  }
  draw_both(file, {1140, 400}, script + "unset multiplot\n");
}

/// Every method a line, every experiment a point on it, in three measures.
void draw_largest(const std::filesystem::path& file, const StabilityMap& map, const Scene& scene) {
  std::vector<Method> methods;
  for (const MapRow* row : rows_of(map, scene, StabilityTest::flat_clump)) methods.push_back(row->method);
  std::string names, blanks, data, lines;
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const std::size_t y = methods.size() - k;
    const char* comma = k == 0 ? "" : ", ";
    names += fmt::format("{}\"{}  {}\" {}", comma, choice_name(methods[k].integrator),
                         rolling_name(methods[k]), y);
    blanks += fmt::format("{}\"\" {}", comma, y);
    if (k > 0 && methods[k].integrator != methods[k - 1].integrator)
      lines += fmt::format(
          "set arrow {0} from graph 0,first {1}.5 to graph 1,first {1}.5 nohead lw 1 lc rgb "
          "'#a3adb8'\n",
          k + 10, y);
  }
  Range range[3];
  for (std::size_t t = 0; t < kStabilityTests.size(); ++t) {
    std::string block;
    for (const MapRow* row : rows_of(map, scene, kStabilityTests[t]))
      for (std::size_t k = 0; k < methods.size(); ++k) {
        const bool own =
            row->any_rolling ? row->method.integrator == methods[k].integrator : row->method == methods[k];
        if (!own || !(row->cliff.stable > 0.0)) continue;
        const double x[3] = {row->cliff.stable / row->smallest_rayleigh,
                             row->cliff.stable / row->equivalent_rayleigh,
                             row->cliff.stable / row->stiffness_time};
        for (int i = 0; i < 3; ++i) range[i].take(x[i]);
        block += fmt::format("{:.6g} {:.6g} {:.6g} {}\n", x[0], x[1], x[2], methods.size() - k);
      }
    data += fmt::format("$test{} << EOD\n{}EOD\n", t, block.empty() ? "NaN NaN NaN NaN\n" : block);
  }
  const std::array labels{"{/:Italic T}_R of the smallest sphere", "{/:Italic T}_R of the equivalent sphere",
                          "√(m/Σ{/:Italic K}) of the stiffest body"};
  std::string script = std::string(kAxes) + data;
  script += fmt::format(
      "set multiplot layout 1,3 margins 0.265,0.985,0.2,0.91 spacing 0.02,0 title '{{/:Bold Largest stable "
      "step}}, stiffness scale {:.3g}; grey: 30 % of {{/:Italic T}}_R' tc rgb '#22303c'\nset logscale x\nset "
      "yrange [0.4:{}]\nset xlabel tc "
      "rgb '#22303c' offset 0,0.4\nunset key\n",
      scene.numerics.stiffness_scale, static_cast<double>(methods.size()) + 0.6);
  std::vector<Entry> entries;
  for (std::size_t t = 0; t < kStabilityTests.size(); ++t)
    entries.push_back({words_of(kStabilityTests[t]), kTestPoints[t], kTestColours[t]});
  script += lines + legend(entries, 0.045);
  script += "set arrow 1 from 0.3,graph 0 to 0.3,graph 1 nohead back lw 5 lc rgb '#dfe3e7'\n";
  for (int i = 0; i < 3; ++i) {
    script += "set ytics noenhanced (" + (i == 0 ? names : blanks) + ")\n";
    if (i == 1) script += "unset arrow 1\nunset label\n";
    script += fmt::format("set xrange [{:.4g}:{:.4g}]\nset xlabel 'step / {}'\n", 0.8 * range[i].low,
                          1.25 * range[i].high, labels[static_cast<std::size_t>(i)]);
    std::string plots;
    for (std::size_t t = 0; t < kStabilityTests.size(); ++t)
      plots += fmt::format("{}$test{} using {}:4 with points pt {} ps 1.1 lw 1.6 lc rgb '{}'",
                           t == 0 ? "plot " : ", ", t, i + 1, kTestPoints[t], kTestColours[t]);
    script += plots + "\n";
  }
  draw_both(file, {1140, 470}, script + "unset multiplot\n");
}

}  // namespace

std::vector<std::string> draw_stability(const StabilityMap& map, const Scene& scene,
                                        const Tolerance& tolerance, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const StabilityTest test : kStabilityTests) {
    const std::vector<const MapRow*> rows = rows_of(map, scene, test);
    if (std::ranges::none_of(rows, [](const MapRow* row) { return !row->cliff.probes.empty(); })) continue;
    names.push_back("energy_" + std::string(name_of(test)));
    draw_energy(folder / names.back(), rows, test, tolerance);
  }
  names.emplace_back("largest_steps");
  draw_largest(folder / names.back(), map, scene);
  return names;
}

}  // namespace repose::report
