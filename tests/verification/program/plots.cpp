#include "verification/program/plots.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "tools/plot/gnuplot.hpp"

namespace repose::verification {

namespace {

constexpr std::array kColours{"#22303c", "#b5532a", "#2f6f9f", "#5a8f4a", "#8a5a9f", "#c79a2b"};

void write_csv(const Plot& plot, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "series,x,y\n";
  for (const Series& series : plot.series)
    for (std::size_t k = 0; k < series.x.size(); ++k)
      out << fmt::format("\"{}\",{:.12g},{:.12g}\n", series.name, series.x[k], series.y[k]);
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

/// Values of a series as gnuplot reads them.
std::string data_block(std::size_t number, const Series& series) {
  std::string block = fmt::format("$s{} << EOD\n", number);
  for (std::size_t k = 0; k < series.x.size(); ++k)
    block += fmt::format("{:.12g} {:.12g}\n", series.x[k], series.y[k]);
  return block + "EOD\n";
}

/// Points keep their colours apart; a dashed line is drawn in the colour of the series before it where the
/// axes are logarithmic, because there it is that series' theory.
std::string look(const Plot& plot, std::size_t number) {
  const Series& series = plot.series[number];
  const bool theory_of_last = plot.logarithmic && series.look == Series::Look::dashes && number > 0;
  const char* colour = kColours[(plot.logarithmic ? number / 2 : number) % kColours.size()];
  switch (series.look) {
    case Series::Look::points:
      return fmt::format("with points pt {} ps 0.9 lw 1.5 lc rgb '{}'", 4 + 2 * (number / 2 % 4), colour);
    case Series::Look::line:
      return fmt::format("with lines lw 1.6 lc rgb '{}'", colour);
    case Series::Look::dashes:
      return fmt::format("with lines lw {} dt 2 lc rgb '{}'", theory_of_last ? 1.2 : 3.0, colour);
  }
  return {};
}

}  // namespace

void write_plot(const Plot& plot, const std::filesystem::path& folder) {
  write_csv(plot, folder / (plot.file + ".csv"));
  std::string script = fmt::format(
      "set terminal svg size 760,480 enhanced font 'Helvetica,15' background '#ffffff'\nset output '{}'\n"
      "set encoding utf8\nset title '{}' noenhanced\nset xlabel '{}' noenhanced\nset ylabel '{}' noenhanced\n"
      "set key outside right center vertical Left reverse spacing 1.3 noenhanced\n"
      "set border 3 lc rgb '#5c6975'\nset tics nomirror textcolor rgb '#22303c'\n"
      "set grid lc rgb '#e1e5e9' lt 1\nset offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04\n",
      gnuplot_quoted((folder / (plot.file + ".svg")).string()), gnuplot_quoted(plot.title),
      gnuplot_quoted(plot.x_label), gnuplot_quoted(plot.y_label));
  if (plot.logarithmic) script += "set logscale xy\nset format '10^{%T}'\nunset offsets\n";
  std::string drawn;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    script += data_block(k, plot.series[k]);
    drawn += fmt::format("{}$s{} using 1:2 {} title '{}'", drawn.empty() ? "plot " : ", ", k, look(plot, k),
                         gnuplot_quoted(plot.series[k].name));
  }
  run_gnuplot(script + drawn + "\n");
}

}  // namespace repose::verification
