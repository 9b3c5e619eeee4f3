#include "tools/report/report_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "tools/plot/gnuplot.hpp"

namespace repose::report {
namespace {

// Ink, accent and greys of the page (report_page.cpp holds the same).
constexpr const char* kAccent = "#b5532a";
constexpr const char* kAccentLight = "#f3d9cb";
constexpr const char* kPoint = "#2b5f8c";
constexpr const char* kGrey = "#a3adb8";
constexpr const char* kContour = "#c6cdd4";
constexpr const char* kInk = "#22303c";

std::string header() {
  return fmt::format(
      "set encoding utf8\n"
      "set border 3 lw 1 lc rgb '{0}'\n"
      "set tics nomirror out scale 0.5 tc rgb '{1}'\n"
      "set grid lt 1 lw 0.6 lc rgb '#e6e9ec'\n"
      "set xlabel tc rgb '{1}'\n"
      "set ylabel tc rgb '{1}'\n"
      "unset key\n",
      kGrey, kInk);
}

void draw(const std::filesystem::path& svg, const std::string& script) {
  run_gnuplot(
      fmt::format("set terminal svg size 520,470 enhanced font 'Helvetica,15' background '#ffffff'\n"
                  "set output '{}'\n{}{}",
                  gnuplot_quoted(svg.string()), header(), script));
}

fit::Range padded(const fit::Range& range, double share) {
  const double width = range.high - range.low;
  const double pad = width > 0.0 ? share * width : std::max(0.05 * std::abs(range.high), 1e-3);
  return {range.low - pad, range.high + pad};
}

std::string axis(const char* name, const fit::Range& range) {
  return fmt::format("set {}range [{:.9g}:{:.9g}]\n", name, range.low, range.high);
}

/// A step of 1, 2 or 5 times a power of ten that divides the range into about `parts`.
double round_step(const fit::Range& range, int parts) {
  const double raw = (range.high - range.low) / parts;
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * decade * 1.0001) return factor * decade;
  }
  return 10.0 * decade;
}

struct DesignPoint {
  double mu_s, mu_r;
  double mean_angle;
};

/// Pairs that were simulated, with the mean angle over restitution and repeats.
std::vector<DesignPoint> design_points(const std::vector<fit::Observation>& used) {
  std::map<std::pair<double, double>, std::pair<double, int>> sums;
  for (const fit::Observation& row : used) {
    auto& [sum, count] = sums[{row.mu_s, row.mu_r}];
    sum += row.angle;
    ++count;
  }
  std::vector<DesignPoint> points;
  for (const auto& [pair, sum] : sums) points.push_back({pair.first, pair.second, sum.first / sum.second});
  return points;
}

std::string data_of(const char* name, const std::vector<DesignPoint>& points) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const DesignPoint& p : points)
    text += fmt::format("{:.9g} {:.9g} {:.1f}\n", p.mu_s, p.mu_r, p.mean_angle);
  return text + "EOD\n";
}

std::string data_of(const std::string& name, const std::vector<fit::LevelPoint>& curve) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const fit::LevelPoint& p : curve) text += fmt::format("{:.9g} {:.9g}\n", p.mu_s, p.mu_r);
  return text + "EOD\n";
}

std::string data_of(const char* name, const std::vector<fit::BandRow>& band) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const fit::BandRow& row : band) text += fmt::format("{:.9g} {:.9g}\n", row.mu_s.low, row.mu_r);
  for (auto row = band.rbegin(); row != band.rend(); ++row) {
    text += fmt::format("{:.9g} {:.9g}\n", row->mu_s.high, row->mu_r);
  }
  return text + "EOD\n";
}

/// A label beyond the end of a curve, on the side of the domain that it leaves by.
std::string end_label(const std::string& text, const fit::LevelPoint& end, const fit::Domain& domain,
                      const std::string& style) {
  std::string place = "center offset 0,-0.75";
  if (end.mu_s >= domain.mu_s.high * (1.0 - 1e-9))
    place = "left offset 0.4,0";
  else if (end.mu_r >= domain.mu_r.high * (1.0 - 1e-9))
    place = "center offset 0,0.75";
  else if (end.mu_s <= domain.mu_s.low * (1.0 + 1e-9))
    place = "right offset -0.4,0";
  return fmt::format("set label '{}' at {:.9g},{:.9g} {} {}\n", text, end.mu_s, end.mu_r, place, style);
}

struct Layers {
  std::string before;              ///< data and settings
  std::vector<std::string> plots;  ///< from the back to the front
};

void add_other_angles(Layers& layers, const fit::PowerLaw& law, double e, bool e_given, double measured) {
  fit::Question question;
  question.curve_points = 61;
  if (e_given) question.e = e;
  fit::Range angles{law.predict({e, law.domain.mu_s.low, law.domain.mu_r.low}), 0.0};
  angles.high = angles.low;
  for (const double s : {law.domain.mu_s.low, law.domain.mu_s.high}) {
    for (const double r : {law.domain.mu_r.low, law.domain.mu_r.high}) {
      const double angle = law.predict({e, s, r});
      angles = {std::min(angles.low, angle), std::max(angles.high, angle)};
    }
  }
  if (!(angles.high > angles.low)) return;
  const double step = round_step(angles, 10);
  for (double k = std::ceil(angles.low / step); k * step < angles.high; ++k) {
    question.angle = k * step;
    if (std::abs(question.angle - measured) < 0.3 * step || question.angle >= 90.0) continue;
    const auto curve = fit::invert(law, question).level_set;
    const std::string name = fmt::format("angle{}", static_cast<long>(k));
    layers.before += data_of(name, curve);
    layers.before += end_label(fmt::format("{:.3g}°", question.angle), curve.back(), law.domain,
                               fmt::format("tc rgb '#7d8894' font ',12'"));
    layers.plots.push_back(fmt::format("${} with lines lw 1 lc rgb '{}'", name, kContour));
  }
}

void add_measured_angle(Layers& layers, const fit::PowerLaw& law, const fit::Inversion& inversion) {
  layers.before += data_of("band", inversion.band) + data_of("curve", inversion.level_set);
  const fit::Question& question = inversion.question;
  const std::string sigma = question.sigma > 0.0 ? fmt::format(" ± {:.2g}°", question.sigma) : "";
  layers.before += end_label(fmt::format("{{/:Bold {:.4g}°{}}}", question.angle, sigma),
                             inversion.level_set.front(), law.domain, fmt::format("tc rgb '{}'", kAccent));
  layers.plots.insert(
      layers.plots.begin(),
      fmt::format("$band with filledcurves closed fs solid noborder fc rgb '{}'", kAccentLight));
  layers.plots.push_back(fmt::format("$curve with lines lw 3 lc rgb '{}'", kAccent));
}

void add_solution(Layers& layers, const fit::Solution& solution) {
  layers.before +=
      fmt::format("$solution << EOD\n{:.9g} {:.9g} {:.9g} {:.9g}\nEOD\n", solution.value.mu_s,
                  solution.value.mu_r, solution.solved_mu_s ? solution.low.mu_s : solution.low.mu_r,
                  solution.solved_mu_s ? solution.high.mu_s : solution.high.mu_r);
  layers.plots.push_back(fmt::format("$solution using 1:2:3:4 with {} lw 2.5 pt 7 ps 1.2 lc rgb '{}'",
                                     solution.solved_mu_s ? "xerrorbars" : "yerrorbars", kInk));
}

// Numbers stand below the points of the upper edge, where the measured angle is written above them.
void add_design(Layers& layers, const fit::Domain& domain, const std::vector<DesignPoint>& points) {
  constexpr std::size_t kLabelled = 30;  // more numbers would cover each other
  layers.before += data_of("design", points);
  layers.plots.push_back(fmt::format("$design using 1:2 with points pt 7 ps 0.75 lc rgb '{}'", kPoint));
  if (points.size() > kLabelled) return;
  for (const bool upper : {false, true}) {
    layers.plots.push_back(
        fmt::format("$design using 1:($2 {} {:.9g} ? $2 : NaN):(sprintf('%.1f', $3)) with labels left offset "
                    "0.6,{} font ',11' tc rgb '{}'",
                    upper ? ">=" : "<", domain.mu_r.high * (1.0 - 1e-9), upper ? -0.55 : 0.55, kPoint));
  }
}

void draw_plane(const std::filesystem::path& svg, const fit::PowerLaw& law,
                const std::optional<fit::Inversion>& inversion, const std::vector<fit::Observation>& used) {
  const fit::Domain& domain = law.domain;
  const double e = inversion ? inversion->e : std::sqrt(domain.e.low * domain.e.high);
  Layers layers;
  layers.before =
      "set xlabel '{/:Italic μ}_s   static friction'\nset ylabel '{/:Italic μ}_r   rolling friction'\n" +
      axis("x", padded(domain.mu_s, 0.1)) + axis("y", padded(domain.mu_r, 0.1));
  add_other_angles(layers, law, e, inversion && inversion->e_is_given,
                   inversion ? inversion->question.angle : 0.0);
  if (inversion) add_measured_angle(layers, law, *inversion);
  add_design(layers, domain, design_points(used));
  if (inversion && inversion->solution) add_solution(layers, *inversion->solution);
  draw(svg, layers.before + fmt::format("plot {}\n", fmt::join(layers.plots, ", \\\n     ")));
}

void draw_line(const std::filesystem::path& svg, const fit::PowerLaw& law,
               const std::optional<fit::Inversion>& inversion, const std::vector<fit::Observation>& used) {
  const bool sliding = law.c.identified;
  const fit::Domain& domain = law.domain;
  const fit::Range& x = sliding ? domain.mu_s : domain.mu_r;
  const double e = inversion ? inversion->e : std::sqrt(domain.e.low * domain.e.high);
  std::string script =
      fmt::format("set xlabel '{{/:Italic μ}}_{}   {} friction'\nset ylabel 'angle of repose  α / °'\n",
                  sliding ? "s" : "r", sliding ? "static" : "rolling");
  script += axis("x", padded(x, 0.06)) + "$law << EOD\n";
  constexpr int kSteps = 80;
  for (int i = 0; i <= kSteps; ++i) {
    const double value = x.low + (x.high - x.low) * i / kSteps;
    const fit::Factors at{e, sliding ? value : domain.mu_s.low, sliding ? domain.mu_r.low : value};
    script += fmt::format("{:.9g} {:.9g}\n", value, law.predict(at));
  }
  script += "EOD\n$points << EOD\n";
  for (const fit::Observation& row : used) {
    script += fmt::format("{:.9g} {:.9g}\n", sliding ? row.mu_s : row.mu_r, row.angle);
  }
  script += "EOD\n";
  std::string plot = fmt::format(
      "$law with lines lw 2 lc rgb '{}', $points with points pt 7 ps 0.7 lc rgb '{}'", kGrey, kPoint);
  if (inversion) {
    const fit::Question& question = inversion->question;
    plot = fmt::format(
        "'+' using 1:({:.9g}):({:.9g}) with filledcurves fs solid noborder fc rgb '{}', "
        "{:.9g} with lines lw 2 lc rgb '{}', {}",
        question.angle - 1.96 * question.sigma, question.angle + 1.96 * question.sigma, kAccentLight,
        question.angle, kAccent, plot);
    const fit::Solution& s = *inversion->solution;
    script += fmt::format("$solution << EOD\n{:.9g} {:.9g} {:.9g} {:.9g}\nEOD\n",
                          sliding ? s.value.mu_s : s.value.mu_r, question.angle,
                          sliding ? s.low.mu_s : s.low.mu_r, sliding ? s.high.mu_s : s.high.mu_r);
    plot += fmt::format(", $solution using 1:2:3:4 with xerrorbars lw 2.5 pt 7 ps 1.2 lc rgb '{}'", kInk);
  }
  draw(svg, script + "plot " + plot + "\n");
}

}  // namespace

void draw_predicted_against_simulated(const std::filesystem::path& svg, const fit::PowerLaw& law,
                                      const std::vector<fit::Observation>& used) {
  fit::Range angles{used.front().angle, used.front().angle};
  std::string script = "$points << EOD\n";
  for (const fit::Observation& row : used) {
    const double predicted = law.predict(fit::factors_of(row));
    angles.low = std::min({angles.low, row.angle, predicted});
    angles.high = std::max({angles.high, row.angle, predicted});
    script += fmt::format("{:.9g} {:.9g} {:.9g}\n", row.angle, predicted, row.standard_error);
  }
  script += "EOD\n";
  const fit::Range range = padded(angles, 0.06);
  const double worst_x = law.worst_point.angle;
  const double worst_y = law.predict(fit::factors_of(law.worst_point));
  script += fmt::format("$worst << EOD\n{:.9g} {:.9g}\nEOD\n", worst_x, worst_y);
  script += axis("x", range) + axis("y", range) + "set size ratio 1\n";
  script += "set xlabel 'simulated angle / °'\nset ylabel 'angle of the equation / °'\n";
  script += fmt::format("set label '{}{:.2g}°' at {:.9g},{:.9g} {} tc rgb '{}' font ',12' front\n",
                        worst_y < worst_x ? "−" : "+", std::abs(worst_y - worst_x), worst_x, worst_y,
                        worst_y < worst_x ? "left offset 1,-0.7" : "right offset -1,0.7", kAccent);
  script += fmt::format(
      "w = {0:.9g}\n"
      "plot '+' using 1:($1-w):($1+w) with filledcurves fs solid noborder fc rgb '#f1f4f6', \\\n"
      "     x-w with lines dt (6,5) lw 1 lc rgb '{1}', x+w with lines dt (6,5) lw 1 lc rgb '{1}', \\\n"
      "     x with lines lw 1.5 lc rgb '{1}', \\\n"
      "     $points using 1:2:3 with xerrorbars lw 0.8 ps 0 lc rgb '#9db8cf', \\\n"
      "     $points using 1:2 with points pt 7 ps 0.7 lc rgb '{2}', \\\n"
      "     $worst using 1:2 with points pt 6 ps 1.6 lw 2 lc rgb '{3}'\n",
      law.worst_error, kGrey, kPoint, kAccent);
  draw(svg, script);
}

bool spans_plane(const fit::PowerLaw& law) {
  return law.b.identified && law.c.identified && law.domain.mu_s.low < law.domain.mu_s.high &&
         law.domain.mu_r.low < law.domain.mu_r.high;
}

void draw_friction(const std::filesystem::path& svg, const fit::PowerLaw& law,
                   const std::optional<fit::Inversion>& inversion,
                   const std::vector<fit::Observation>& used) {
  if (spans_plane(law)) {
    draw_plane(svg, law, inversion, used);
  } else {
    draw_line(svg, law, inversion, used);
  }
}

}  // namespace repose::report
