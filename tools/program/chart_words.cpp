#include "tools/program/chart_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/program/sweep_runner.hpp"

namespace repose::program {

namespace {

std::string padded(const std::string& text, std::size_t width) {
  const auto letters = static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  return text + std::string(letters < width ? width - letters : 0, ' ');
}

std::string signed_estimate(const chart::Estimate& estimate, int digits) {
  return fmt::format("{:+.{}f} ± {:.{}f}", estimate.value, digits, estimate.standard_error, digits);
}

std::string line_of(const chart::Chart& chart, const chart::Comparison& rung, std::size_t width) {
  const chart::Judgement& angle = rung.angle;
  return fmt::format(
      "{} {:9.3g} {:8.2f}  {}  {:6.2f}  {}  {:5.2f}{} {:6.2f}  {}  {}  {}{}\n", padded(rung.name, width),
      rung.cpu, rung.speed_up, padded(signed_estimate(angle.mean, 2), 13), angle.mean_bound_95,
      padded(signed_estimate(angle.worst, 2), 13), angle.error, angle.depends_on_friction ? "*" : " ",
      angle.bound_95, padded(signed_estimate(rung.density.mean, 1), 11),
      padded(signed_estimate(rung.mass.mean, 1) + (rung.mass.depends_on_friction ? "*" : ""), 12),
      chart.working_point.empty()
          ? ""
          : padded(rung.off_working_point ? signed_estimate(*rung.off_working_point, 2) : "", 15),
      (rung.on_front ? "front " : "") +
          (chart.frictions.size() > 1 ? "worst at " + chart.frictions[angle.worst_at] : std::string()));
}

std::string so_far(const chart::Chart& chart) {
  std::string text = fmt::format("so far: {} replicates of the reference, {} of the rungs; {} runs to come",
                                 chart.replicates, chart.rung_replicates, chart.missing_runs);
  for (std::size_t k = 0; k < chart.unfinished.size(); ++k)
    text += (k == 0 ? "; not there yet: " : ", ") + chart.unfinished[k];
  return text + "\n";
}

}  // namespace

std::string in_words(const chart::Chart& chart) {
  std::size_t width = 9;
  std::vector<const chart::Comparison*> order;
  for (const chart::Comparison& rung : chart.rungs) {
    width = std::max(width, rung.name.size());
    if (rung.completed) order.push_back(&rung);
  }
  std::ranges::stable_sort(order, [](const auto* a, const auto* b) { return a->cpu > b->cpu; });
  std::string text = fmt::format(
      "{} {:>9} {:>8}  {}  <95 %   {}  error °  <95 %  {}  {}  {}\n{} {:9.3g} {:8.2f}  scatter of one run "
      "{:.2f}°\n",
      padded("rung", width), "CPU s", "speed-up", padded("angle diff. °", 13), padded("worst °", 13),
      padded("density %", 11), padded("mass %", 12), chart.working_point.empty() ? "" : "off working pt.",
      padded("reference", width), chart.reference_cpu, 1.0, chart.scatter);
  bool any_dependence = false;
  for (const chart::Comparison* rung : order) {
    text += line_of(chart, *rung, width);
    any_dependence = any_dependence || rung->angle.depends_on_friction || rung->mass.depends_on_friction;
  }
  text +=
      "error: root mean square over the sets of frictions; <95 %: the mean, or the error, is below this with "
      "95 % confidence";
  if (any_dependence) text += "; * depends on the frictions (F test, 5 % level)";
  text += "\n";
  for (const chart::Comparison& rung : chart.rungs)
    if (!rung.completed)
      text += fmt::format("{}: not completed ({}): {}\n", rung.name, in_words(rung.outcomes), rung.reason);
  for (const chart::Comparison& rung : chart.rungs)
    if (rung.one_column)
      text += fmt::format(
          "{}: all runs settle the same column, and what it has of its own stands in no error: two columns "
          "or "
          "more (/test/shared_columns/count) show it\n",
          rung.name);
  if (chart.missing_runs > 0) text += so_far(chart);
  if (chart.engines.size() > 1)
    text +=
        fmt::format("runs of several processors ({}): their CPU seconds, and so speed-ups, do not compare\n",
                    fmt::join(chart.engines, ", "));
  if (chart.frictions.size() < 3)
    text += fmt::format(
        "only {} of frictions: the error of a simplification can depend on them, three and more are "
        "advised\n",
        chart.frictions.size() == 1 ? "one set" : "two sets");
  return text;
}

std::string in_words(const chart::Comparison& rung) {
  if (!rung.completed) return fmt::format("not completed ({}): {}", in_words(rung.outcomes), rung.reason);
  return fmt::format("{:.2f}° off (below {:.2f}° with 95 % confidence; {} in the mean), {:.3g} times cheaper",
                     rung.angle.error, rung.angle.bound_95, signed_estimate(rung.angle.mean, 2),
                     rung.speed_up);
}

std::string reference_failed(const chart::Chart& chart) {
  return fmt::format("the reference did not complete ({}): there is nothing to compare with; {}",
                     in_words(chart.reference_outcomes), chart.reference_failure);
}

}  // namespace repose::program
