#include "tools/report/chart_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "chart/kinds.hpp"
#include "tools/plot/gnuplot.hpp"

namespace repose::report {

namespace {

// The picture in pixels; the plot's frame inside it, so that labels can be placed free of each other.
constexpr double kWidth = 1180.0, kHeight = 760.0;
constexpr double kLeft = 80.0, kRight = 1150.0, kTop = 110.0, kBottom = 690.0;
constexpr double kColumn = 220.0;              ///< beside the plot, where some rung did not complete
constexpr double kLetter = 7.4, kLine = 16.0;  ///< of a label

constexpr const char* kCliff = "#b3261e";
constexpr std::array kColours = {"#2b5f8c", "#b5532a", "#4d8b57", "#7a5195", "#c28e0e", "#1f8a8a",
                                 "#a63d66", "#6b6f2a", "#5a6b7a", "#8c5a3c", "#3f51b5", "#00695c"};

struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  [[nodiscard]] double overlap(const Box& other) const {
    const double w = std::min(x + width, other.x + other.width) - std::max(x, other.x);
    const double h = std::min(y + height, other.y + other.height) - std::max(y, other.y);
    return w > 0.0 && h > 0.0 ? w * h : 0.0;
  }
};

/// A rung on the picture.
struct Spot {
  const chart::Comparison* rung = nullptr;
  std::string kind;  ///< what sets it apart (chart::kinds_of)
  std::string colour;
  double x = 0.0, y = 0.0;  ///< pixels
};

class ChartPlot {
 public:
  explicit ChartPlot(const chart::Chart& chart) : chart_(chart), kinds_(chart::kinds_of(chart.variants)) {
    double low = chart.reference_cpu, high = chart.reference_cpu, worst = std::max(1.0, chart.scatter);
    for (const chart::Comparison& rung : chart.rungs) {
      if (!rung.completed) continue;
      low = std::min(low, rung.cpu);
      high = std::max(high, rung.cpu);
      worst = std::max(worst, rung.angle.bound_95);
    }
    right_ = has_failures() ? kRight - kColumn : kRight;
    x_low_ = low / 1.35;
    x_high_ = high * 1.35;
    y_high_ = 1.12 * worst;
    std::map<std::string, std::string> colours;
    for (std::size_t k = 0; k < chart.rungs.size(); ++k) {
      if (!chart.rungs[k].completed) continue;
      Spot spot{&chart.rungs[k], kinds_[k], "", x_of(chart.rungs[k].cpu), y_of(chart.rungs[k].angle.error)};
      spot.colour = colours.emplace(spot.kind, kColours[colours.size() % kColours.size()]).first->second;
      spots_.push_back(spot);
    }
  }

  [[nodiscard]] std::string script() {
    add_frame();
    add_noise();
    add_kinds();
    add_front();
    add_points();
    add_cliffs();
    add_names();
    add_failures();
    return before_ + fmt::format("plot {}\n", fmt::join(plots_, ", \\\n     "));
  }

 private:
  [[nodiscard]] double x_of(double cpu) const {
    return kLeft + (right_ - kLeft) * std::log(cpu / x_low_) / std::log(x_high_ / x_low_);
  }
  [[nodiscard]] double y_of(double error) const {
    return kBottom - (kBottom - kTop) * std::sqrt(std::clamp(error / y_high_, 0.0, 1.0));
  }

  void add_frame() {
    before_ += fmt::format(
        "set encoding utf8\nset lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
        "set tmargin at screen {:.6f}\nset bmargin at screen {:.6f}\n",
        kLeft / kWidth, right_ / kWidth, 1.0 - kTop / kHeight, 1.0 - kBottom / kHeight);
    before_ +=
        "set border 3 lw 1 lc rgb '#a3adb8'\nset tics nomirror out scale 0.5 tc rgb '#22303c'\n"
        "set grid lt 1 lw 0.6 lc rgb '#e6e9ec'\nunset key\nset logscale x\n"
        "set nonlinear y via sqrt(y) inverse y*y\n";
    before_ += fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [0:{:.9g}]\n", x_low_, x_high_, y_high_);
    before_ += tics("x", x_low_, x_high_, 1.0, "");
    std::string ticks = "'0°' 0";
    double last = kBottom;
    for (const double tick : {0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0}) {
      if (tick > y_high_ || last - y_of(tick) < 1.2 * kLine) continue;
      ticks += fmt::format(", '{0:g}°' {0:g}", tick);
      last = y_of(tick);
    }
    before_ += fmt::format("set ytics ({})\n", ticks);
    before_ +=
        "set xlabel 'CPU seconds a run' tc rgb '#22303c'\n"
        "set ylabel 'error of the angle, root mean square over the frictions' tc rgb '#22303c'\n";
    before_ += fmt::format(
        "set label '{{/:Bold Speed against accuracy}}' at screen {0:.4f},0.965 left font ',17' tc rgb "
        "'#22303c'\n"
        "set label '{1}' at screen {0:.4f},0.927 left font ',12' tc rgb '#5c6975' noenhanced\n",
        kLeft / kWidth, gnuplot_quoted(heading()));
  }

  /// 1, 2 and 5 of each decade of value × scale between two ends.
  static std::string tics(const char* axis, double low, double high, double scale, const char* unit) {
    std::string list;
    for (double decade = std::pow(10.0, std::floor(std::log10(low * scale))); decade <= high * scale;
         decade *= 10.0)
      for (const double factor : {1.0, 2.0, 5.0})
        if (const double value = factor * decade; value >= low * scale && value <= high * scale)
          list += fmt::format("{}'{:g}{}' {:.9g}", list.empty() ? "" : ", ", value, unit, value / scale);
    return fmt::format("set {}tics ({})\n", axis, list);
  }

  [[nodiscard]] std::string heading() const {
    std::string text = chart_.title;
    if (constexpr std::size_t kMost = 62; text.size() > kMost) {  // bytes: no letter may be cut in two
      std::size_t end = kMost;
      while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
      text = text.substr(0, end) + "…";
    }
    return fmt::format("{}{}{} sets of frictions, {} replicates each; bars: 90 % confidence", text,
                       text.empty() ? "" : "; ", chart_.frictions.size(), chart_.replicates);
  }

  void add_noise() {
    before_ += fmt::format(
        "set object 1 rect from {:.9g},0 to {:.9g},{:.9g} fs solid noborder fc rgb '#f0ece4' behind\n"
        "set label 'scatter of one run: {:.2g}°' at {:.9g},{:.9g} right offset -0.8,-0.7 font ',11' tc rgb "
        "'#8a7d62'\n",
        x_low_, x_high_, chart_.scatter, chart_.scatter, x_high_, chart_.scatter);
    taken_.push_back({right_ - 180.0, y_of(chart_.scatter), 180.0, 1.2 * kLine});
  }

  /// Rungs of one kind, from the dearest to the cheapest, with what they depart from: the working point, the
  /// rung of no kind of its own, or else the reference.
  void add_kinds() {
    std::map<std::string, std::vector<const Spot*>> kinds;
    for (const Spot& spot : spots_) kinds[spot.kind].push_back(&spot);
    const std::pair<double, double> reference{chart_.reference_cpu, 0.0};
    std::pair<double, double> origin = reference;
    if (const auto own = kinds.find(""); own != kinds.end()) origin = place_of(*own->second.front()->rung);
    int number = 0;
    for (const auto& [kind, members] : kinds) {
      std::vector<std::pair<double, double>> places{kind.empty() ? reference : origin};
      for (const Spot* spot : members) places.push_back(place_of(*spot->rung));
      std::ranges::sort(places, std::greater{});
      const std::string name = fmt::format("kind{}", number++);
      before_ += fmt::format("${} << EOD\n", name);
      for (const auto& [cpu, error] : places) before_ += fmt::format("{:.9g} {:.9g}\n", cpu, error);
      before_ += "EOD\n";
      plots_.push_back(
          fmt::format("${} with lines lw 0.8 dt (4,4) lc rgb '{}'", name, members.front()->colour));
    }
  }

  static std::pair<double, double> place_of(const chart::Comparison& rung) {
    return {rung.cpu, rung.angle.error};
  }

  void add_front() {
    std::vector<const chart::Comparison*> front;
    for (const chart::Comparison& rung : chart_.rungs)
      if (rung.on_front) front.push_back(&rung);
    std::ranges::sort(front, [](const auto* a, const auto* b) { return a->cpu < b->cpu; });
    before_ += "$front << EOD\n";
    double x = x_of(chart_.reference_cpu), y = kBottom;
    for (auto rung = front.rbegin(); rung != front.rend(); ++rung) {
      const double next_x = x_of((*rung)->cpu), next_y = y_of((*rung)->angle.error);
      take_line(x, y, next_x, next_y);
      x = next_x, y = next_y;
    }
    for (const chart::Comparison* rung : front)
      before_ += fmt::format("{:.9g} {:.9g}\n", rung->cpu, rung->angle.error);
    before_ += fmt::format("{:.9g} 0\nEOD\n", chart_.reference_cpu);
    plots_.push_back("$front with lines lw 5 lc rgb '#dfe6ee'");
    plots_.push_back("$front with lines lw 1.6 lc rgb '#22303c'");
  }

  void add_points() {
    before_ += "$reference << EOD\n" + fmt::format("{:.9g} 0\nEOD\n", chart_.reference_cpu);
    for (std::size_t k = 0; k < spots_.size(); ++k) {
      const chart::Judgement& angle = spots_[k].rung->angle;
      before_ += fmt::format("$point{} << EOD\n{:.9g} {:.9g} {:.9g} {:.9g}\nEOD\n", k, spots_[k].rung->cpu,
                             angle.error, angle.low_95, angle.bound_95);
      plots_.push_back(fmt::format("$point{} using 1:2:3:4 with yerrorbars lw 1.1 pt 7 ps 0 lc rgb '{}'", k,
                                   spots_[k].colour));
      plots_.push_back(fmt::format("$point{} using 1:2 with points pt {} ps {} lc rgb '{}'", k, 7,
                                   spots_[k].rung->on_front ? 1.15 : 0.85, spots_[k].colour));
    }
    plots_.push_back("$reference with points pt 13 ps 2 lc rgb '#22303c'");
    for (const Spot& spot : spots_) {
      taken_.push_back({spot.x - 5.0, spot.y - 5.0, 10.0, 10.0});
      take_line(spot.x, y_of(spot.rung->angle.low_95), spot.x, y_of(spot.rung->angle.bound_95));
    }
    taken_.push_back({x_of(chart_.reference_cpu) - 8.0, kBottom - 8.0, 16.0, 16.0});
  }

  /// Where a name stands that hides least of the others; those of the front choose first.
  void add_names() {
    std::vector<const Spot*> order;
    for (const Spot& spot : spots_) order.push_back(&spot);
    std::ranges::stable_sort(order, {}, [](const Spot* spot) { return spot->rung->on_front ? 0 : 1; });
    add_name("reference", "#22303c", true, x_of(chart_.reference_cpu), kBottom, 1.0);
    for (const Spot* spot : order)
      add_name(spot->rung->name, spot->colour, spot->rung->on_front, spot->x, spot->y, spot->rung->speed_up);
  }

  void add_name(const std::string& name, const std::string& colour, bool bold, double x, double y,
                double speed_up) {
    const std::string text = speed_up == 1.0 ? name : fmt::format("{}  {:.2g}×", name, speed_up);
    const double width = kLetter * static_cast<double>(letters_of(text)) * (bold ? 1.13 : 1.0);
    Box best;
    double least = 1e300;
    for (const double distance : {0.0, 14.0, 28.0, 44.0}) {
      for (const auto& [dx, dy] : {std::pair{9.0, -8.0},
                                   {-9.0 - width, -8.0},
                                   {-width / 2.0, -25.0},
                                   {-width / 2.0, 9.0},
                                   {9.0, -24.0},
                                   {9.0, 8.0},
                                   {-9.0 - width, -24.0},
                                   {-9.0 - width, 8.0}}) {
        const double away = dy < -8.0 ? -distance : distance;
        const Box box{x + dx, y + dy + away, width, kLine};
        double hidden = 0.02 * distance;
        for (const Box& other : taken_) hidden += box.overlap(other);
        if (box.x < kLeft || box.x + width > right_ + 20.0 || box.y < kTop || box.y + kLine > kBottom + 2.0)
          hidden += 1e4;
        if (hidden < least) least = hidden, best = box;
      }
    }
    taken_.push_back(best);
    before_ +=
        fmt::format("set label '{}' at screen {:.5f},{:.5f} left font '{},11' tc rgb '{}' noenhanced front\n",
                    gnuplot_quoted(text), best.x / kWidth, 1.0 - (best.y + 0.5 * kLine) / kHeight,
                    bold ? "Helvetica-Bold" : "", colour);
  }

  static std::size_t letters_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  }

  /// In a column beside the plot.
  void add_failures() {
    if (!has_failures()) return;
    int line = 0;
    const auto write = [&](const std::string& text, const char* font, const char* colour) {
      before_ += fmt::format("set label '{}' at screen {:.5f},{:.5f} left font '{}' tc rgb '{}' noenhanced\n",
                             gnuplot_quoted(text), (right_ + 26.0) / kWidth,
                             1.0 - (kTop + 8.0 + 1.15 * kLine * line++) / kHeight, font, colour);
    };
    write("Not completed", "Helvetica-Bold,12", kCliff);
    for (const chart::Comparison& rung : chart_.rungs) {
      if (rung.completed) continue;
      std::string outcomes;
      for (const auto& [outcome, runs] : rung.outcomes)
        if (outcome != "completed")
          outcomes += fmt::format("{}{} {}", outcomes.empty() ? "" : ", ", runs, outcome);
      write("✕ " + rung.name, "Helvetica,11", kCliff);
      write("    " + outcomes, "Helvetica,10", "#5c6975");
    }
    write("○ a cliff: the next rung", "Helvetica,11", kCliff);
    write("    of its kind fails", "Helvetica,11", kCliff);
  }

  [[nodiscard]] bool has_failures() const {
    return std::ranges::any_of(chart_.rungs, [](const auto& rung) { return !rung.completed; });
  }

  /// The cheapest rung that completed of every kind of which another did not.
  void add_cliffs() {
    before_ += "$cliffs << EOD\n";
    std::map<std::string, const chart::Comparison*> last;
    for (const Spot& spot : spots_) {
      const chart::Comparison*& cheapest = last[spot.kind];
      if (cheapest == nullptr || spot.rung->cpu < cheapest->cpu) cheapest = spot.rung;
    }
    bool any = false;
    for (std::size_t k = 0; k < chart_.rungs.size(); ++k) {
      const auto found = last.find(kinds_[k]);
      if (chart_.rungs[k].completed || found == last.end()) continue;
      before_ += fmt::format("{:.9g} {:.9g}\n", found->second->cpu, found->second->angle.error);
      any = true;
    }
    before_ += "EOD\n";
    if (any) plots_.push_back(fmt::format("$cliffs with points pt 6 ps 2 lw 1.6 lc rgb '{}'", kCliff));
  }

  /// The way between two places hides no name.
  void take_line(double x1, double y1, double x2, double y2) {
    const double length = std::hypot(x2 - x1, y2 - y1);
    const int parts = 1 + static_cast<int>(length / 8.0);
    for (int k = 0; k <= parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      taken_.push_back({x1 + share * (x2 - x1) - 2.0, y1 + share * (y2 - y1) - 2.0, 4.0, 4.0});
    }
  }

  const chart::Chart& chart_;
  std::vector<std::string> kinds_;  ///< of the rungs
  double right_ = kRight;           ///< of the plot
  double x_low_ = 0.0, x_high_ = 0.0, y_high_ = 0.0;
  std::vector<Spot> spots_;
  std::vector<Box> taken_;
  std::string before_;
  std::vector<std::string> plots_;
};

}  // namespace

void draw_chart(const std::filesystem::path& file, const chart::Chart& chart) {
  const bool svg = file.extension() == ".svg";
  const std::string terminal =
      svg ? fmt::format("svg size {:.0f},{:.0f} enhanced font 'Helvetica,13' background '#ffffff'", kWidth,
                        kHeight)
          : fmt::format("pngcairo size {:.0f},{:.0f} enhanced font 'Helvetica,12' background '#ffffff'",
                        kWidth, kHeight);
  run_gnuplot(fmt::format("set terminal {}\nset output '{}'\n{}", terminal, gnuplot_quoted(file.string()),
                          ChartPlot(chart).script()));
}

}  // namespace repose::report
