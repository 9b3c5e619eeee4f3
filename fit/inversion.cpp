#include "fit/inversion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/distributions.hpp"
#include "fit/selection.hpp"

namespace repose::fit {
namespace {

// Rounding of ln α: an angle at the very corner of the domain counts as reached.
constexpr double kEdge = 1e-9;

std::string text(const Range& range) {
  return range.low == range.high ? fmt::format("{:.4g}", range.low)
                                 : fmt::format("{:.4g} ... {:.4g}", range.low, range.high);
}

Eigen::Index row_of(Factor factor) { return 1 + static_cast<Eigen::Index>(factor); }

double exponent(const PowerLaw& law, Factor factor) {
  return law.parameters()[static_cast<std::size_t>(factor) + 1]->value;
}

bool is_free(const PowerLaw& law, Factor factor) {
  const Range& range = range_of(law.domain, factor);
  return law.parameters()[static_cast<std::size_t>(factor) + 1]->identified && range.low < range.high;
}

const std::optional<double>& given(const Question& question, Factor factor) {
  switch (factor) {
    case Factor::mu_r:
      return question.mu_r;
    case Factor::mu_s:
      return question.mu_s;
    default:
      return question.e;
  }
}

/// @param varies  whether there is an exponent to solve a factor by
template <class Varies>
std::vector<std::string> faults_of(const Domain& domain, const Question& question, const Varies& varies) {
  std::vector<std::string> faults;
  if (!(question.angle > 0.0 && question.angle < 90.0)) {
    faults.push_back(fmt::format("angle = {} deg: must be > 0 and < 90", question.angle));
  }
  if (!(question.sigma >= 0.0 && std::isfinite(question.sigma))) {
    faults.push_back(fmt::format("sigma = {} deg: must be >= 0", question.sigma));
  }
  if (question.curve_points < 2) faults.emplace_back("a curve needs at least 2 points");
  for (const Factor factor : kFactors) {
    const auto& value = given(question, factor);
    const Range& range = range_of(domain, factor);
    const double margin = kEdge * std::abs(range.high);
    if (value && !(*value >= range.low - margin && *value <= range.high + margin)) {
      faults.push_back(
          fmt::format("{} = {}: outside the domain of the fit, {}", name_of(factor), *value, text(range)));
    }
  }
  const bool free_s = varies(Factor::mu_s);
  const bool free_r = varies(Factor::mu_r);
  if (!free_s && !free_r) {
    faults.emplace_back("neither mu_s nor mu_r varies in the table: there is no friction to solve for");
  } else if ((question.mu_s || !free_s) && (question.mu_r || !free_r)) {
    faults.emplace_back("mu_s and mu_r are both fixed: nothing is left to solve for");
  }
  return faults;
}

// Every fault of the question at once.
void check(const PowerLaw& law, const Question& question) {
  const auto faults = faults_of(law.domain, question, [&law](Factor factor) { return is_free(law, factor); });
  if (!faults.empty()) throw Unusable(fmt::format("{}", fmt::join(faults, "\n")));
}

struct Band {
  double value;  ///< not clipped
  Range range;   ///< clipped to the domain; low > high if it lies outside
  bool cut;      ///< by the domain
  bool bounded;  ///< the angle depends on the factor beyond doubt
};

/// Solves the equation for one factor, the others as in `at`, with the band of invert().
Band solve_for(const PowerLaw& law, const Question& question, Factor unknown, Factors at) {
  const Range& domain = range_of(law.domain, unknown);
  const double power = exponent(law, unknown);
  if (power == 0.0) return {std::sqrt(domain.low * domain.high), domain, true, false};
  const Eigen::Index k = row_of(unknown);
  const Eigen::Vector4d theta(std::log(law.C.value), law.a.value, law.b.value, law.c.value);
  set(at, unknown, 1.0);
  const double log_value = (std::log(question.angle) - law.log_row(at).dot(theta)) / power;
  Eigen::Vector4d h = law.log_row(at);
  h(k) = log_value;

  const double t2 = std::pow(student_t_quantile(0.975, law.error.degrees_of_freedom), 2);
  const double z2 = std::pow(student_t_quantile(0.975, std::numeric_limits<double>::infinity()), 2);
  const double of_law =
      h.dot(law.covariance * h) + std::pow(law.error.standard_deviation / question.angle, 2);
  const double of_measurement = std::pow(question.sigma / question.angle, 2);

  // (power δ)² ≤ t² (V + 2 δ (Σh)_k + δ² Σ_kk) + z² σ²/α² with δ = ln x − ln x*: between the roots of A δ² −
  // 2 B δ − D.
  const double A = power * power - t2 * law.covariance(k, k);
  const double B = t2 * law.covariance.row(k).dot(h);
  const double D = t2 * of_law + z2 * of_measurement;
  Band band{std::exp(log_value), domain, true, A > 0.0};
  if (!band.bounded) return band;
  const double root = std::sqrt(B * B + A * D);
  const double low = band.value * std::exp((B - root) / A);
  const double high = band.value * std::exp((B + root) / A);
  band.range = {std::max(low, domain.low), std::min(high, domain.high)};
  band.cut = low < domain.low || high > domain.high;
  return band;
}

double clamped(double value, const Range& range) { return std::clamp(value, range.low, range.high); }

// Keeps a point of the curve inside its own band where rounding would put it a digit outside.
Range around(const Band& band, double value) {
  return {std::min(band.range.low, value), std::max(band.range.high, value)};
}

/// Angles over the domain: the law is monotonic in every factor, so that the corners hold the extremes.
Range reachable_range(const PowerLaw& law, double e, const Range& mu_s, const Range& mu_r) {
  Range angles{std::numeric_limits<double>::infinity(), 0.0};
  for (const double s : {mu_s.low, mu_s.high}) {
    for (const double r : {mu_r.low, mu_r.high}) {
      const double angle = law.predict({e, s, r});
      angles = {std::min(angles.low, angle), std::max(angles.high, angle)};
    }
  }
  return angles;
}

void require_reachable(double angle, const Range& angles, double e, const Range& mu_s, const Range& mu_r) {
  if (angle >= angles.low * (1.0 - kEdge) && angle <= angles.high * (1.0 + kEdge)) return;
  throw Unreachable(
      fmt::format(
          "angle = {} deg cannot be reached: the equation gives {:.2f} ... {:.2f} deg over the domain "
          "(e_pp = {:.4g}, mu_s = {}, mu_r = {}); widen the sweep",
          angle, angles.low, angles.high, e, text(mu_s), text(mu_r)),
      angles);
}

/// The line n·(ln μr, ln μs) = K, cut by the box of the domain: its two ends.
std::array<Eigen::Vector2d, 2> clip_line(const Eigen::Vector2d& n, double K, const Eigen::Vector2d& low,
                                         const Eigen::Vector2d& high) {
  const Eigen::Vector2d centre = 0.5 * (low + high);
  const Eigen::Vector2d direction = Eigen::Vector2d(-n(1), n(0)).normalized();
  const Eigen::Vector2d nearest = centre + n * ((K - n.dot(centre)) / n.squaredNorm());
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < 2; ++i) {
    if (direction(i) == 0.0) continue;
    const double p = (low(i) - nearest(i)) / direction(i);
    const double q = (high(i) - nearest(i)) / direction(i);
    begin = std::max(begin, std::min(p, q));
    end = std::min(end, std::max(p, q));
  }
  if (begin > end) begin = end = 0.5 * (begin + end);  // touches a corner, but for rounding
  return {nearest + begin * direction, nearest + end * direction};
}

// Requires both frictions to vary.
void draw_curve(const PowerLaw& law, Inversion& result) {
  const Range& mu_s = law.domain.mu_s;
  const Range& mu_r = law.domain.mu_r;
  const Eigen::Vector2d n(law.b.value, law.c.value);
  const double K = std::log(result.question.angle / law.predict({result.e, 1.0, 1.0}));
  const auto ends =
      clip_line(n, K, {std::log(mu_r.low), std::log(mu_s.low)}, {std::log(mu_r.high), std::log(mu_s.high)});
  const bool forward = ends[0](1) != ends[1](1) ? ends[0](1) < ends[1](1) : ends[0](0) < ends[1](0);
  const Eigen::Vector2d& first = ends[forward ? 0 : 1];
  const Eigen::Vector2d& last = ends[forward ? 1 : 0];
  for (int i = 0; i < result.question.curve_points; ++i) {
    const double share = static_cast<double>(i) / (result.question.curve_points - 1);
    const Eigen::Vector2d at = first + share * (last - first);
    LevelPoint point;
    point.mu_r = clamped(std::exp(at(0)), mu_r);
    point.mu_s = clamped(std::exp(at(1)), mu_s);
    const Factors factors{result.e, point.mu_s, point.mu_r};
    point.mu_s_band = around(solve_for(law, result.question, Factor::mu_s, factors), point.mu_s);
    point.mu_r_band = around(solve_for(law, result.question, Factor::mu_r, factors), point.mu_r);
    result.level_set.push_back(point);
  }
}

void draw_band(const PowerLaw& law, Inversion& result) {
  constexpr int kRows = 121;
  const Range& mu_r = law.domain.mu_r;
  for (int i = 0; i < kRows; ++i) {
    const double value = clamped(mu_r.low * std::pow(mu_r.high / mu_r.low, i / (kRows - 1.0)), mu_r);
    const Band band = solve_for(law, result.question, Factor::mu_s, {result.e, 1.0, value});
    if (band.range.low <= band.range.high) result.band.push_back({value, band.range});
  }
}

void solve(const PowerLaw& law, Inversion& result, Factor unknown, Factor known) {
  const Question& question = result.question;
  if (exponent(law, unknown) == 0.0) {
    throw Unusable(fmt::format("the angle does not depend on {} in this equation", name_of(unknown)));
  }
  const Range& range = range_of(law.domain, known);
  Factors at{result.e, 0.0, 0.0};
  set(at, known, clamped(given(question, known).value_or(range.low), range));
  const Factors fixed = at;
  const Range held{value_of(fixed, known), value_of(fixed, known)};
  const Range& mu_s = unknown == Factor::mu_s ? law.domain.mu_s : held;
  const Range& mu_r = unknown == Factor::mu_r ? law.domain.mu_r : held;
  require_reachable(question.angle, reachable_range(law, result.e, mu_s, mu_r), result.e, mu_s, mu_r);
  const Band band = solve_for(law, question, unknown, at);
  const double value = clamped(band.value, range_of(law.domain, unknown));
  const Range interval = around(band, value);
  Solution solution{at, at, at, unknown == Factor::mu_s, band.cut};
  set(solution.value, unknown, value);
  set(solution.low, unknown, interval.low);
  set(solution.high, unknown, interval.high);
  result.solution = solution;
  result.identifiable = band.bounded;
}

}  // namespace

std::vector<std::string> faults_of(const Domain& domain, const Question& question) {
  return faults_of(domain, question, [&domain](Factor factor) {
    return range_of(domain, factor).low < range_of(domain, factor).high;
  });
}

Inversion invert(const PowerLaw& law, const Question& question) {
  check(law, question);
  Inversion result;
  result.question = question;
  result.e_is_given = question.e.has_value();
  if (law.covariance.isZero(0.0))
    result.remark = fmt::format(
        "The fit gives no covariance: its equation is taken as exact, and bands hold {} alone.",
        law.error.standard_deviation > 0.0
            ? "the error of the measured angle and the scatter of single angles about the equation"
            : "the error of the measured angle");
  const Range& e = law.domain.e;
  result.e = clamped(question.e.value_or(std::sqrt(e.low * e.high)), e);
  if (law.a.identified) {
    const double power = law.a.value;
    result.restitution_effect =
        question.angle * (std::pow(e.high / result.e, power) - std::pow(e.low / result.e, power));
  }
  const bool curve = is_free(law, Factor::mu_s) && is_free(law, Factor::mu_r);
  if (curve && law.b.value == 0.0 && law.c.value == 0.0)
    throw Unusable("the angle depends on neither mu_s nor mu_r in this equation");
  const bool solve_mu_s = is_free(law, Factor::mu_s) && !question.mu_s;
  result.reachable = reachable_range(law, result.e, law.domain.mu_s, law.domain.mu_r);
  if (!curve || question.mu_s || question.mu_r) {
    solve(law, result, solve_mu_s ? Factor::mu_s : Factor::mu_r, solve_mu_s ? Factor::mu_r : Factor::mu_s);
  }
  if (curve) {
    require_reachable(question.angle, result.reachable, result.e, law.domain.mu_s, law.domain.mu_r);
    draw_curve(law, result);
    draw_band(law, result);
  } else {
    const Solution& only = *result.solution;
    result.level_set.push_back(
        {only.value.mu_s, only.value.mu_r, {only.low.mu_s, only.high.mu_s}, {only.low.mu_r, only.high.mu_r}});
  }
  return result;
}

}  // namespace repose::fit
