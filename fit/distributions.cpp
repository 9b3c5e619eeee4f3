#include "fit/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace repose::fit {

namespace law = boost::math;

double student_t_quantile(double probability, double degrees_of_freedom) {
  return law::quantile(law::students_t(degrees_of_freedom), probability);
}

double f_upper_tail(double ratio, double d1, double d2) {
  if (ratio <= 0.0) return 1.0;
  if (std::isinf(ratio)) return 0.0;
  return law::cdf(law::complement(law::fisher_f(d1, d2), ratio));
}

double noncentrality(double x, double k, double probability) {
  constexpr double kNormalFrom = 1000.0;
  if (x > kNormalFrom) {
    const double root = std::sqrt(x) - law::quantile(law::normal(), probability);
    return std::max(0.0, root * root - (k - 1.0));
  }
  if (law::cdf(law::chi_squared(k), x) <= probability) return 0.0;
  return law::non_central_chi_squared::find_non_centrality(k, x, probability);
}

}  // namespace repose::fit
