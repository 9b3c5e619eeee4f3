#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "tools/report/study_report.hpp"

namespace repose::report {
namespace {

std::string degrees(double angle) { return fmt::format("{:.2f}°", angle); }

std::string measured(const fit::Question& question) {
  const std::string angle = fmt::format("a measured angle of {:.4g}°", question.angle);
  return question.sigma > 0.0 ? fmt::format("{} ± {:.2g}°", angle, question.sigma) : angle;
}

std::string capital(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z') {
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  }
  return sentence;
}

struct Named {
  const char* symbol;  ///< "μs"
  const char* option;  ///< "mu_s"
  double value;
  fit::Range interval;
};

Named solved_for(const fit::Solution& s) {
  return s.solved_mu_s ? Named{"μs", "mu_s", s.value.mu_s, {s.low.mu_s, s.high.mu_s}}
                       : Named{"μr", "mu_r", s.value.mu_r, {s.low.mu_r, s.high.mu_r}};
}

std::string of_solution(const fit::Inversion& inversion) {
  const fit::Solution& solution = *inversion.solution;
  const Named x = solved_for(solution);
  const std::string given = solution.solved_mu_s ? fmt::format("μr = {:.3g}", solution.value.mu_r)
                                                 : fmt::format("μs = {:.3g}", solution.value.mu_s);
  if (!inversion.identifiable) {
    return fmt::format(
        "{} does not fix {}: over the values swept the angle does not depend on it beyond the scatter of the "
        "runs. The equation alone would say {} = {:.3g} (with {}, e = {:.3g}), but any other value agrees as "
        "well.",
        capital(measured(inversion.question)), x.symbol, x.symbol, x.value, given, inversion.e);
  }
  std::string text = fmt::format(
      "With {} and e = {:.3g}, {} gives {} = {:.3g}, with 95 % confidence between {:.3g} and {:.3g}.", given,
      inversion.e, measured(inversion.question), x.symbol, x.value, x.interval.low, x.interval.high);
  if (solution.reaches_the_edge) {
    text += fmt::format(
        " This interval is cut by the edge of the values swept; a wider sweep of {} would "
        "show where it ends.",
        x.symbol);
  }
  return text;
}

/// Whether the 95 % interval of an exponent leaves 0 out, or nothing is known of it.
bool shows(const fit::Estimate& exponent) {
  return !(exponent.interval_95.low <= 0.0 && exponent.interval_95.high >= 0.0);
}

std::string of_curve(const fit::PowerLaw& law, const fit::Inversion& inversion) {
  if (!shows(law.b) && !shows(law.c))
    return fmt::format(
        "{} fixes neither friction: over the values swept the angle depends on μs and μr no more than "
        "the runs scatter, and any pair agrees as well.",
        capital(measured(inversion.question)));
  const fit::LevelPoint& first = inversion.level_set.front();
  const fit::LevelPoint& middle = inversion.level_set[inversion.level_set.size() / 2];
  const fit::LevelPoint& last = inversion.level_set.back();
  const fit::Range& swept = law.domain.mu_s;
  const bool cut = middle.mu_s_band.low <= swept.low || middle.mu_s_band.high >= swept.high;
  return fmt::format(
      "{} is met by a whole curve of friction pairs, not by one pair. At e = {:.3g} the curve runs from "
      "μs = {:.3g} with μr = {:.3g} to μs = {:.3g} with μr = {:.3g}. Half-way lies μs = {:.3g} with "
      "μr = {:.3g}; at that μr the angle allows μs between {:.3g} and {:.3g} (95 %{}).",
      capital(measured(inversion.question)), inversion.e, first.mu_s, first.mu_r, last.mu_s, last.mu_r,
      middle.mu_s, middle.mu_r, middle.mu_s_band.low, middle.mu_s_band.high,
      cut ? ", cut by the edge of the values swept" : "");
}

std::string of_restitution(const fit::PowerLaw& law, const fit::Inversion& inversion) {
  const fit::Range& e = law.domain.e;
  if (!law.a.identified) {
    return fmt::format("Restitution was {:.3g} in every run: its effect is not part of this study.", e.low);
  }
  const double effect = inversion.restitution_effect;
  std::string text =
      fmt::format("From e = {:.3g} to {:.3g} the angle changes by {:+.2g}°", e.low, e.high, effect);
  // Not knowing e moves the angle by half of this either way; that is small beside one standard deviation.
  const double deviation = std::hypot(law.error.standard_deviation, inversion.question.sigma);
  const double worst =
      std::isfinite(law.worst_error) ? law.worst_error : 0.0;  // a law written by hand has none
  if (std::abs(effect) <= std::max(worst, 2.0 * deviation)) {
    return text +
           ", within the errors of the equation and of the measurement: restitution need not be known well.";
  }
  return text + (inversion.e_is_given
                     ? ": the value of e that was given matters."
                     : fmt::format(": restitution matters here. The answer is for e = {:.3g}, the middle of "
                                   "the values swept; give a measured one (--fix e_pp=...).",
                                   inversion.e));
}

// The friction with the smaller exponent is the one whose error does the least harm when it is guessed.
bool rolling_is_weaker(const fit::PowerLaw& law) { return std::abs(law.b.value) <= std::abs(law.c.value); }

std::string of_next_step(const fit::PowerLaw& law) {
  const bool rolling = rolling_is_weaker(law);
  const double ratio = rolling ? std::abs(law.b.value / law.c.value) : std::abs(law.c.value / law.b.value);
  std::string text = fmt::format(
      "Fix {} next, by a test of its own or from a similar material: the angle depends on it the least, so "
      "that "
      "a value 10 % off moves {} by {:.2g} % only",
      rolling ? "μr" : "μs", rolling ? "μs" : "μr", 10.0 * ratio);
  return text +
         (ratio > 0.0 ? fmt::format(" (the other way round it would be {:.2g} %).", 10.0 / ratio) : ".");
}

/// A word that a shell takes as it is.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./+,:=@%-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string next_command(const fit::PowerLaw& law, const fit::Inversion& inversion,
                         const std::string& source) {
  const bool rolling = rolling_is_weaker(law);
  const fit::LevelPoint& middle = inversion.level_set[inversion.level_set.size() / 2];
  const fit::Question& question = inversion.question;
  return fmt::format("{}repose invert {} --angle {:.6g}{}{} --fix {}={:.2g}", kCommand, shell_word(source),
                     question.angle,
                     question.sigma > 0.0 ? fmt::format(" --sigma {:.4g}", question.sigma) : "",
                     inversion.e_is_given ? fmt::format(" --fix e_pp={:.4g}", inversion.e) : "",
                     rolling ? "mu_r" : "mu_s", rolling ? middle.mu_r : middle.mu_s);
}

std::string of_band(const fit::PowerLaw& law, const fit::Inversion& inversion) {
  const double sigma = inversion.question.sigma;
  const double scatter = law.error.standard_deviation;
  if (!inversion.remark.empty()) return inversion.remark;
  if (sigma <= 0.0) {
    return "No error of the measured angle was given (--sigma): the band holds the equation's own error "
           "alone.";
  }
  if (sigma >= scatter) {
    return fmt::format(
        "Most of the band comes from the measured angle ({:.2g}° against {:.2g}° of the equation): repeat "
        "the "
        "measurement to narrow it.",
        sigma, scatter);
  }
  return fmt::format(
      "Most of the band comes from the equation ({:.2g}° against {:.2g}° of the measured angle): a sweep "
      "closer "
      "around the answer narrows it.",
      scatter, sigma);
}

std::string of_excluded(const fit::PowerLaw& law) {
  if (law.excluded.empty()) return {};
  std::map<std::string, int> count;
  for (const fit::Excluded& row : law.excluded) ++count[row.reason];
  std::string text = law.excluded.size() == 1 ? std::string(" One run is left out")
                                              : fmt::format(" {} runs are left out", law.excluded.size());
  const char* before = ": ";
  for (const auto& [reason, runs] : count) {
    text += before + (count.size() > 1 ? fmt::format("{} × {}", runs, reason) : reason);
    before = "; ";
  }
  return text + ".";
}

std::string of_equation(const fit::PowerLaw& law) {
  std::string text = fmt::format("The equation, {} (degrees)", equation_in_words(law));
  if (law.points > 0) {
    const fit::Observation& worst = law.worst_point;
    text += fmt::format(
        ", misses the {} simulated angles by {} at most (at e = {:.3g}, μs = {:.3g}, μr = {:.3g}) and by {} "
        "in "
        "the root mean square.",
        law.points, degrees(law.worst_error), worst.e, worst.mu_s, worst.mu_r, degrees(law.rms_error));
  } else {
    text += ", was given without the angles behind it.";
  }
  return text + of_excluded(law);
}

// Breaks at spaces; UTF-8 continuation bytes take no column.
std::string broken(const std::string& paragraph, std::size_t width) {
  std::string text;
  std::size_t column = 0;
  std::size_t begin = 0;
  while (begin < paragraph.size()) {
    std::size_t end = std::min(paragraph.find(' ', begin), paragraph.size());
    const std::string word = paragraph.substr(begin, end - begin);
    const auto columns = static_cast<std::size_t>(std::count_if(
        word.begin(), word.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
    if (column > 0 && column + 1 + columns > width) {
      text += '\n';
      column = 0;
    } else if (column > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += columns;
    begin = end + 1;
  }
  return text;
}

}  // namespace

std::string equation_in_words(const fit::PowerLaw& law) {
  std::string text = fmt::format("α = {:.4g}", law.C.value);
  if (law.a.identified) text += fmt::format(" e^{:.2g}", law.a.value);
  if (law.b.identified) text += fmt::format(" μr^{:.3g}", law.b.value);
  if (law.c.identified) text += fmt::format(" μs^{:.3g}", law.c.value);
  return text;
}

std::vector<std::string> answer_paragraphs(const fit::PowerLaw& law, const fit::Inversion& inversion,
                                           const std::string& source) {
  std::vector<std::string> text;
  text.push_back(inversion.solution ? of_solution(inversion) : of_curve(law, inversion));
  if (!inversion.solution && (shows(law.b) || shows(law.c))) {
    text.push_back(of_next_step(law));
    if (!source.empty()) text.push_back(next_command(law, inversion, source));
  }
  text.push_back(of_restitution(law, inversion));
  text.push_back(of_band(law, inversion));
  text.push_back(of_equation(law));
  return text;
}

std::string answer_in_words(const fit::PowerLaw& law, const fit::Inversion& inversion,
                            const std::string& source) {
  constexpr std::size_t kWidth = 100;
  std::string text;
  for (const std::string& paragraph : answer_paragraphs(law, inversion, source)) {
    text += (paragraph.starts_with(kCommand) ? paragraph : broken(paragraph, kWidth)) + '\n';
  }
  return text;
}

}  // namespace repose::report
