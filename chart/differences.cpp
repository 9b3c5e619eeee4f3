#include "chart/differences.hpp"

#include <cmath>
#include <numeric>

#include "fit/student_t.hpp"

namespace repose::chart {

namespace {

constexpr double kPoolingLevel = 0.25;
constexpr double kConfidence = 0.95;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// t(0.95, ν). A search judges combinations by the hundred thousand, all with one ν.
double bound_quantile(double degrees_of_freedom) {
  thread_local double known_for = 0.0, known = 0.0;
  if (degrees_of_freedom != known_for) {
    known = fit::student_t_quantile(kConfidence, degrees_of_freedom);
    known_for = degrees_of_freedom;
  }
  return known;
}

}  // namespace

Judgement judge(const Differences& differences) {
  Judgement judgement;
  const auto sets = static_cast<double>(differences.size());
  const auto n = static_cast<double>(differences.front().size());
  double within = 0.0;
  for (const std::vector<double>& set : differences) {
    const double mean = mean_of(set);
    judgement.by_set.push_back({mean, 0.0});
    judgement.mean.value += mean / sets;
    for (const double value : set) within += (value - mean) * (value - mean);
  }
  judgement.degrees_of_freedom = sets * (n - 1.0);
  const double variance = within / judgement.degrees_of_freedom;
  double between = 0.0;
  for (std::size_t s = 0; s < differences.size(); ++s) {
    Estimate& set = judgement.by_set[s];
    set.standard_error = std::sqrt(variance / n);
    between += n * std::pow(set.value - judgement.mean.value, 2);
    if (s == 0 || std::abs(set.value) > std::abs(judgement.worst.value)) {
      judgement.worst = set;
      judgement.worst_at = s;
    }
  }
  judgement.mean.standard_error = std::sqrt(variance / (n * sets));
  if (sets > 1.0 && between > 0.0)
    judgement.dependence_p = variance > 0.0 ? fit::f_upper_tail(between / (sets - 1.0) / variance, sets - 1.0,
                                                                judgement.degrees_of_freedom)
                                            : 0.0;
  judgement.depends_on_friction = judgement.dependence_p < kPoolingLevel;
  judgement.error = judgement.depends_on_friction ? judgement.worst : judgement.mean;
  judgement.error.value = std::abs(judgement.error.value);
  judgement.bound_95 =
      judgement.error.value + bound_quantile(judgement.degrees_of_freedom) * judgement.error.standard_error;
  return judgement;
}

}  // namespace repose::chart
