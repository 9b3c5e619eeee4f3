#include "chart/comparison.hpp"

#include <algorithm>
#include <cmath>

namespace repose::chart {

namespace {

template <class Visit>
void for_each_pair(const Samples& test, const Samples& reference, Visit visit) {
  for (std::size_t set = 0; set < test.size(); ++set)
    for (std::size_t run = 0; run < test[set].size(); ++run) visit(set, test[set][run], reference[set][run]);
}

Estimate relative_percent(const Samples& test, const Samples& reference, double Sample::*response) {
  Differences differences(test.size());
  for_each_pair(test, reference, [&](std::size_t set, const Sample& one, const Sample& other) {
    differences[set].push_back(100.0 * (one.*response / other.*response - 1.0));
  });
  return judge(differences).mean;
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

double scatter_of_angle(const Samples& samples) {
  Differences angles(samples.size());
  for (std::size_t set = 0; set < samples.size(); ++set)
    for (const Sample& sample : samples[set]) angles[set].push_back(sample.angle);
  return judge(angles).by_set.front().standard_error * std::sqrt(static_cast<double>(samples.front().size()));
}

Differences angle_differences(const Samples& test, const Samples& reference) {
  Differences differences(test.size());
  for_each_pair(test, reference, [&](std::size_t set, const Sample& one, const Sample& other) {
    differences[set].push_back(one.angle - other.angle);
  });
  return differences;
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
  rung.angle = judge(angle_differences(test, reference));
  rung.density = relative_percent(test, reference, &Sample::density);
  rung.mass = relative_percent(test, reference, &Sample::mass);
  return rung;
}

void mark_front(std::vector<Comparison>& rungs, double reference_cpu) {
  for (Comparison& rung : rungs) {
    rung.on_front = rung.completed && rung.cpu < reference_cpu &&
                    std::ranges::none_of(rungs, [&](const Comparison& other) {
                      return other.completed && &other != &rung && other.cpu <= rung.cpu &&
                             other.angle.error.value <= rung.angle.error.value;
                    });
  }
}

}  // namespace repose::chart
