#include "stability/hostile/sample/hostile_sample.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/base/input_error.hpp"
#include "engine/scene/scene_reader.hpp"
#include "stability/hostile/sample/hostile_check.hpp"

namespace repose::hostile {

namespace {

/// Sets a flag once a time has passed, unless it is destroyed before.
class Alarm {
 public:
  Alarm(std::atomic<bool>& flag, double seconds)
      : thread_([this, &flag, seconds] {
          std::unique_lock lock(mutex_);
          if (!wake_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return over_; }))
            flag = true;
        }) {}
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  ~Alarm() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::thread thread_;
};

RunResult run_in_time(const Scene& scene, std::uint64_t seed, double longest) {
  std::atomic<bool> stop = false;
  const Alarm alarm(stop, longest);
  RunOptions options;
  options.stop = &stop;
  return run_slump_test(scene, seed, options);
}

class Sample {
 public:
  explicit Sample(const SampleOptions& options) : options_(options) {}

  void add(std::uint64_t index) {
    const HostileCase hostile = hostile_case(options_.seed, index, options_.root);
    const std::optional<RunResult> result = run(hostile, index);
    if (!result || result->outcome != Outcome::completed) return;
    for (const Warning& warning : result->warnings) ++report.warnings[warning.name];
    report.largest_imbalance =
        std::max(report.largest_imbalance, std::abs(result->energy.relative_imbalance()));
    if (motion_is_questioned(*result)) return;
    ++report.unquestioned;
    if (static_cast<int>(report.reruns.size()) < options_.reruns) rerun(hostile, *result, index);
  }

  void judge_the_mean() {
    if (report.reruns.size() > 2 &&
        std::abs(report.mean_difference()) > 3.0 * report.error_of_mean_difference())
      report.faults.push_back(
          {0, fmt::format("a quarter of the step changes the angle by {:.2f} ± {:.2f}° in the mean",
                          degrees(report.mean_difference()), degrees(report.error_of_mean_difference()))});
  }

  SampleReport report;

 private:
  std::optional<RunResult> run(const HostileCase& hostile, std::uint64_t index) {
    Faults faults;
    const Scene scene = read_scene(CaseDocument::from_json(hostile.json, "case.json"), faults);
    if (!faults.empty()) {
      ++report.outcomes["refused"][index % kBoldness.size()];
      return std::nullopt;
    }
    RunResult result = run_in_time(scene, hostile.seed, options_.longest);
    ++report.outcomes[name_of(result.outcome)][index % kBoldness.size()];
    for (const std::string& text : faults_of(scene, result)) report.faults.push_back({index, text});
    book(result.cost.cpu, index);
    return result;
  }

  void rerun(const HostileCase& hostile, const RunResult& first, std::uint64_t index) {
    const HostileCase finer = with_a_quarter_of_the_step(hostile);
    const Scene scene = read_scene(CaseDocument::from_json(finer.json, "case.json"));
    const RunResult second = run_in_time(scene, finer.seed, options_.longest);
    if (second.outcome == Outcome::unreadable || second.outcome == Outcome::no_heap ||
        second.outcome == Outcome::timed_out) {
      ++report.reruns_without_angle[name_of(second.outcome)];
      return;
    }
    if (second.outcome != Outcome::completed) {
      report.faults.push_back({index, fmt::format("with a quarter of the step it ends {}: {}",
                                                  name_of(second.outcome), second.reason)});
      return;
    }
    const Rerun pair{index, first.measurement.angle, second.measurement.angle,
                     std::hypot(first.measurement.standard_error, second.measurement.standard_error)};
    report.reruns.push_back(pair);
    if (std::abs(pair.deviation()) > kMostDeviations)
      report.faults.push_back(
          {index, fmt::format("{:.1f}°, and {:.1f}° with a quarter of the step (± {:.1f}°)",
                              degrees(pair.angle), degrees(pair.angle_of_quarter), degrees(pair.error))});
  }

  void book(double cpu, std::uint64_t index) {
    report.cpu += cpu;
    if (cpu <= report.slowest) return;
    report.slowest = cpu;
    report.slowest_index = index;
  }

  const SampleOptions& options_;
};

}  // namespace

double SampleReport::mean_difference() const {
  double sum = 0.0;
  for (const Rerun& pair : reruns) sum += pair.angle_of_quarter - pair.angle;
  return sum / static_cast<double>(reruns.size());
}

double SampleReport::error_of_mean_difference() const {
  const double mean = mean_difference(), n = static_cast<double>(reruns.size());
  double squares = 0.0;
  for (const Rerun& pair : reruns) squares += std::pow(pair.angle_of_quarter - pair.angle - mean, 2);
  return std::sqrt(squares / (n * (n - 1.0)));
}

SampleReport run_sample(const SampleOptions& options) {
  Sample sample(options);
  for (int k = 0; k < options.cases; ++k) {
    if (options.on_progress) options.on_progress(k);
    sample.add(options.first + static_cast<std::uint64_t>(k));
  }
  sample.judge_the_mean();
  return std::move(sample.report);
}

}  // namespace repose::hostile
