#include "chart/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace repose::chart {

namespace {

/// The column of every run; empty where a run had its own.
Columns columns_of(const Samples& samples) {
  Columns columns;
  for (const std::vector<Sample>& set : samples) {
    auto& row = columns.emplace_back();
    for (const Sample& sample : set) {
      if (!sample.column) return {};
      row.push_back(*sample.column);
    }
  }
  return columns;
}

bool share_one_column(const Samples& samples) {
  const Columns columns = columns_of(samples);
  return !columns.empty() && std::ranges::all_of(columns, [&](const auto& row) {
    return std::ranges::all_of(row, [&](std::uint64_t one) { return one == columns[0][0]; });
  });
}

std::vector<double> means_of(const Samples& samples, double Sample::*response) {
  std::vector<double> means;
  for (const std::vector<Sample>& set : samples) {
    double sum = 0.0;
    for (const Sample& sample : set) sum += sample.*response;
    means.push_back(sum / static_cast<double>(set.size()));
  }
  return means;
}

/// What columns add to the differences `rows`, told from the runs of the test that shares them, which show it
/// better than differences that hold the noise of the other as well. Where both share the same ones, whose
/// effect may cancel, the differences tell.
template <class Difference>
SharedPart shared_part_of(const Rows& rows, const Samples& test, const Samples& reference,
                          double Sample::*response, Difference difference) {
  const Columns of_test = columns_of(test), of_reference = columns_of(reference);
  if (!of_test.empty() && of_test == of_reference) return shared_part(rows, of_test);
  const auto one_of = [&](const Samples& samples, auto difference_of) {
    Rows runs(samples.size());
    for (std::size_t set = 0; set < samples.size(); ++set)
      for (const Sample& sample : samples[set]) runs[set].push_back(difference_of(sample.*response, set));
    return runs;
  };
  SharedPart part;
  if (!of_test.empty()) {
    const std::vector<double> means = means_of(reference, response);
    part = shared_part(one_of(test, [&](double run, std::size_t set) { return difference(run, means[set]); }),
                       of_test);
  }
  if (!of_reference.empty()) {
    const std::vector<double> means = means_of(test, response);
    part = part + shared_part(one_of(reference, [&](double run,
                                                    std::size_t set) { return difference(means[set], run); }),
                              of_reference);
  }
  return part;
}

/// @param difference  of the test's response, a mean where it has more runs, and the reference's
template <class Difference>
Differences differences_of(const Samples& test, const Samples& reference, double Sample::*response,
                           Difference difference) {
  Differences differences{Rows(test.size()), {}};
  for (std::size_t set = 0; set < test.size(); ++set) {
    const std::size_t pairs = reference[set].size(), runs = test[set].size();
    for (std::size_t pair = 0; pair < pairs; ++pair) {
      double sum = 0.0;
      for (std::size_t run = pair; run < runs; run += pairs) sum += test[set][run].*response;
      const double mean = sum * static_cast<double>(pairs) / static_cast<double>(runs);
      differences.rows[set].push_back(difference(mean, reference[set][pair].*response));
    }
  }
  differences.shared = shared_part_of(differences.rows, test, reference, response, difference);
  return differences;
}

Judgement relative_percent(const Samples& test, const Samples& reference, double Sample::*response) {
  const auto percent = [](double one, double other) { return 100.0 * (one / other - 1.0); };
  return judge(differences_of(test, reference, response, percent));
}

}  // namespace

const Sample* first_failure(const Samples& samples) {
  for (const std::vector<Sample>& set : samples)
    for (const Sample& sample : set)
      if (!sample.completed()) return &sample;
  return nullptr;
}

std::map<std::string, int> outcomes_of(const Samples& samples) {
  std::map<std::string, int> outcomes;
  for (const std::vector<Sample>& set : samples)
    for (const Sample& sample : set) ++outcomes[sample.outcome];
  return outcomes;
}

double mean_cpu(const Samples& samples) {
  double sum = 0.0, count = 0.0;
  for (const std::vector<Sample>& set : samples)
    for (const Sample& sample : set) sum += sample.cpu, count += 1.0;
  return sum / count;
}

Rows angles_of(const Samples& samples) {
  Rows angles(samples.size());
  for (std::size_t set = 0; set < samples.size(); ++set)
    for (const Sample& sample : samples[set]) angles[set].push_back(sample.angle);
  return angles;
}

double scatter_of_angle(const Samples& samples) {
  const Rows angles = angles_of(samples);
  double variances = 0.0;
  const std::vector<Estimate> estimates = estimates_of(angles);
  for (std::size_t set = 0; set < angles.size(); ++set)
    variances += static_cast<double>(angles[set].size()) * std::pow(estimates[set].standard_error, 2);
  return std::sqrt(variances / static_cast<double>(angles.size()));
}

Differences angle_differences(const Samples& test, const Samples& reference) {
  return differences_of(test, reference, &Sample::angle, std::minus{});
}

Comparison compare(const std::string& name, const Samples& test, const Samples& reference) {
  Comparison rung;
  rung.name = name;
  rung.outcomes = outcomes_of(test);
  rung.cpu = mean_cpu(test);
  rung.speed_up = mean_cpu(reference) / rung.cpu;
  if (const Sample* failure = first_failure(test)) {
    rung.reason = failure->reason;
    return rung;
  }
  rung.completed = true;
  rung.one_column = share_one_column(test) || share_one_column(reference);
  rung.angle = judge(angle_differences(test, reference));
  rung.density = relative_percent(test, reference, &Sample::density);
  rung.mass = relative_percent(test, reference, &Sample::mass);
  return rung;
}

void mark_front(std::vector<Comparison>& rungs, double reference_cpu) {
  for (Comparison& rung : rungs) {
    rung.on_front = rung.completed && rung.cpu < reference_cpu &&
                    std::ranges::none_of(rungs, [&](const Comparison& other) {
                      const double cost = other.cpu - rung.cpu;
                      const double error = other.angle.error - rung.angle.error;
                      return other.completed && cost <= 0.0 && error <= 0.0 && (cost < 0.0 || error < 0.0);
                    });
  }
}

}  // namespace repose::chart
