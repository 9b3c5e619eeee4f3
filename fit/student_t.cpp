#include "fit/student_t.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace repose::fit {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Below this tail ν + t² ≈ ν to the last digit and Student's law is the normal one.
constexpr double kNormalFrom = 1e10;

// Lentz's evaluation of the continued fraction; converges in O(√max(a, b)) terms for x < (a+1)/(a+b+2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kTerms = 100000;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double sum = d;
  for (int i = 1; i <= kTerms; ++i) {
    const double m = i;
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / away_from_zero(1.0 + even * d);
    c = away_from_zero(1.0 + even / c);
    sum *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / away_from_zero(1.0 + odd * d);
    c = away_from_zero(1.0 + odd / c);
    const double factor = d * c;
    sum *= factor;
    if (std::abs(factor - 1.0) < 2.0 * kEpsilon) break;
  }
  return sum;
}

double student_t_density(double t, double nu) {
  if (nu > kNormalFrom) return std::exp(-0.5 * t * t) / std::sqrt(2.0 * std::numbers::pi);
  const double front = std::lgamma(0.5 * (nu + 1.0)) - std::lgamma(0.5 * nu);
  return std::exp(front - 0.5 * (nu + 1.0) * std::log1p(t * t / nu)) / std::sqrt(nu * std::numbers::pi);
}

double normal_cdf(double t) { return 0.5 * std::erfc(-t / std::sqrt(2.0)); }

}  // namespace

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double log_front = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  const double front = std::exp(log_front + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

double student_t_cdf(double t, double degrees_of_freedom) {
  if (degrees_of_freedom > kNormalFrom) return normal_cdf(t);
  // Near t = 0 the complement is used: ν/(ν + t²) would lose the digits of t.
  const double nu = degrees_of_freedom;
  const double t2 = t * t;
  const double half_central = t2 < nu ? 0.5 * incomplete_beta(0.5, 0.5 * nu, t2 / (nu + t2))
                                      : 0.5 - 0.5 * incomplete_beta(0.5 * nu, 0.5, nu / (nu + t2));
  return t < 0.0 ? 0.5 - half_central : 0.5 + half_central;
}

double student_t_quantile(double probability, double degrees_of_freedom) {
  if (probability < 0.5) return -student_t_quantile(1.0 - probability, degrees_of_freedom);
  double low = 0.0;
  double high = 1.0;
  while (student_t_cdf(high, degrees_of_freedom) < probability && high < 1e300) {
    low = high;
    high *= 2.0;
  }
  // Newton's steps, and bisection where one would leave the bracket.
  double t = 0.5 * (low + high);
  for (int i = 0; i < 200 && high - low > 2.0 * kEpsilon * high; ++i) {
    const double excess = student_t_cdf(t, degrees_of_freedom) - probability;
    (excess < 0.0 ? low : high) = t;
    const double next = t - excess / student_t_density(t, degrees_of_freedom);
    if (std::abs(next - t) <= kEpsilon * t) return t;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

double f_upper_tail(double ratio, double d1, double d2) {
  if (ratio <= 0.0) return 1.0;
  if (std::isinf(ratio)) return 0.0;
  return incomplete_beta(0.5 * d2, 0.5 * d1, d2 / (d2 + d1 * ratio));
}

}  // namespace repose::fit
