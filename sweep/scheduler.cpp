#include "sweep/scheduler.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>

#include "engine/slump/shared_column.hpp"

namespace repose::sweep {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// One pass over the missing runs. Members below `mutex_` belong to whoever holds it.
class Pass {
 public:
  Pass(const Plan& plan, std::vector<std::size_t> todo, Store& store, CostModel& costs,
       const SweepProgress& begin, const SweepOptions& options)
      : plan_(plan),
        todo_(std::move(todo)),
        store_(store),
        costs_(costs),
        options_(options),
        progress_(begin) {
    threads_ = options.threads > 0 ? options.threads : omp_get_max_threads();
    left_to_make_ = todo_.size();
    started_.assign(todo_.size(), std::nullopt);
    finished_.assign(todo_.size(), false);
    std::ranges::stable_sort(todo_, {}, [&](std::size_t run) {
      const PlannedRun& planned = plan_.runs[run];
      return std::pair(planned.replicate, -costs_.weight(planned.point));
    });
  }

  SweepSummary run() {
    report(true);
    const auto count = static_cast<std::int64_t>(todo_.size());
#pragma omp parallel num_threads(threads_)
    {
#pragma omp for schedule(monotonic : dynamic, 1) nowait
      for (std::int64_t i = 0; i < count; ++i) one(static_cast<std::size_t>(i));
      help_others();
    }
    if (fault_) std::rethrow_exception(fault_);
    summary_.interrupted = progress_.left > 0;
    summary_.wall_s = seconds_since(begin_);
    return summary_;
  }

 private:
  [[nodiscard]] bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  /// No exception may leave the body of a parallel loop.
  void one(std::size_t index) {
    make(index);
    const std::lock_guard lock(mutex_);
    --left_to_make_;
    changed_.notify_all();
  }

  void make(std::size_t index) {
    try {
      if (!start(index)) return;
      const PlannedRun& planned = plan_.runs[todo_[index]];
      RunResult result;
      std::optional<std::string> failure;
      try {
        const OpenCrew open(*this, index);
        result = options_.run(plan_.points[planned.point].scene, planned.seed, run_options(open.crew));
      } catch (const std::exception& error) {
        failure = error.what();
        result.seed = planned.seed;
        result.run_key = planned.key;
      }
      end(index, planned, result, failure);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!fault_) fault_ = std::current_exception();
    }
  }

  /// A run's crew, which idle threads may join until the run ends.
  class OpenCrew {
   public:
    OpenCrew(Pass& pass, std::size_t index) : pass_(pass), index_(index) {
      const std::lock_guard lock(pass_.mutex_);
      pass_.crews_[index_] = crew;
      pass_.changed_.notify_all();
    }
    ~OpenCrew() {
      const std::lock_guard lock(pass_.mutex_);
      pass_.crews_.erase(index_);
      crew->dismiss();
    }
    OpenCrew(const OpenCrew&) = delete;
    OpenCrew& operator=(const OpenCrew&) = delete;

    const std::shared_ptr<Crew> crew = std::make_shared<Crew>();

   private:
    Pass& pass_;
    std::size_t index_;
  };

  /// Until all runs have ended; for a thread that finds none to start.
  void help_others() {
    std::unique_lock lock(mutex_);
    while (left_to_make_ > 0) {
      const auto fewest =
          std::ranges::min_element(crews_, {}, [](const auto& of_run) { return of_run.second->joined(); });
      if (fewest == crews_.end() || fewest->second->is_full()) {
        changed_.wait(lock);
        continue;
      }
      const std::shared_ptr<Crew> crew = fewest->second;
      lock.unlock();
      crew->help();
      lock.lock();
    }
  }

  RunOptions run_options(std::shared_ptr<Crew> crew) {
    RunOptions options;
    options.crew = std::move(crew);
    options.columns = columns_;
    options.stop = options_.stop;
    options.on_progress = [this](const Progress&) {
      const std::unique_lock lock(mutex_, std::try_to_lock);
      if (lock.owns_lock()) report(false);
    };
    return options;
  }

  bool start(std::size_t index) {
    const std::lock_guard lock(mutex_);
    if (fault_ || stopped()) return false;
    started_[index] = Clock::now();
    ++progress_.running;
    report(true);
    return true;
  }

  void end(std::size_t index, const PlannedRun& planned, const RunResult& result,
           const std::optional<std::string>& failure) {
    const std::lock_guard lock(mutex_);
    --progress_.running;
    started_[index].reset();
    finished_[index] = true;
    if (failure || result.outcome != Outcome::interrupted) keep(planned, result, failure);
    report(true);
  }

  void keep(const PlannedRun& planned, const RunResult& result, const std::optional<std::string>& failure) {
    StoredRun run = stored(planned);
    if (failure)
      take_failure(run, *failure);
    else
      take_result(run, result);
    const auto flanks = run.completed() ? std::optional(result.measurement.flanks) : std::nullopt;
    if (store_.put(run, flanks) == Store::Put::differs)
      throw std::runtime_error(
          "run " + run.run_key +
          " ended otherwise than the run of this key that is stored: results of this machine"
          " are not repeatable");
    if (run.cpu_s) {
      costs_.learn(planned.point, *run.cpu_s);
      summary_.cpu_s += *run.cpu_s;
    }
    ++summary_.finished;
    ++progress_.done;
    --progress_.left;
    if (!run.completed()) ++progress_.failed;
    if (options_.on_finished) options_.on_finished(run, result);
  }

  [[nodiscard]] StoredRun stored(const PlannedRun& planned) const {
    StoredRun run;
    const Scene& scene = plan_.points[planned.point].scene;
    run.run_key = planned.key;
    run.point = static_cast<int>(planned.point) + 1;
    run.replicate = planned.replicate;
    run.seed = static_cast<std::int64_t>(planned.seed);
    run.e_pp = scene.contact.particle_particle.restitution;
    run.mu_s = scene.contact.particle_particle.static_friction;
    run.mu_r = scene.contact.particle_particle.rolling_friction;
    run.factors = plan_.factors_of(planned.point);
    run.variant = plan_.variant_of(planned.point);
    return run;
  }

  void report(bool always) {
    if (!options_.on_progress || (!always && seconds_since(reported_) < 1.0)) return;
    reported_ = Clock::now();
    progress_.elapsed_s = seconds_since(begin_);
    progress_.eta_s = eta();
    options_.on_progress(progress_);
  }

  /// The work that is left spread over the threads, but no less than the longest run that is left.
  [[nodiscard]] std::optional<double> eta() const {
    double sum = 0.0;
    double longest = 0.0;
    for (std::size_t i = 0; i < todo_.size(); ++i) {
      if (finished_[i]) continue;
      const auto expected = costs_.seconds(plan_.runs[todo_[i]].point);
      if (!expected) return std::nullopt;
      const double left = started_[i] ? std::max(0.0, *expected - seconds_since(*started_[i])) : *expected;
      sum += left;
      longest = std::max(longest, left);
    }
    return std::max(sum / threads_, longest);
  }

  const Plan& plan_;
  std::vector<std::size_t> todo_;
  Store& store_;
  CostModel& costs_;
  const SweepOptions& options_;
  int threads_ = 1;
  const Clock::time_point begin_ = Clock::now();

  std::mutex mutex_;
  std::size_t left_to_make_ = 0;     ///< of todo_, with those under way
  std::condition_variable changed_;  ///< of a run that begins or ends
  std::shared_ptr<ColumnShelf> columns_ = std::make_shared<ColumnShelf>();
  std::map<std::size_t, std::shared_ptr<Crew>> crews_;  ///< of the runs under way
  SweepProgress progress_;
  SweepSummary summary_;
  Clock::time_point reported_{};
  std::vector<std::optional<Clock::time_point>> started_;
  std::vector<bool> finished_;
  std::exception_ptr fault_;
};

}  // namespace

SweepSummary run_all(const Plan& plan, const std::vector<std::size_t>& todo, Store& store, CostModel& costs,
                     const SweepProgress& begin, const SweepOptions& options) {
  return Pass(plan, todo, store, costs, begin, options).run();
}

}  // namespace repose::sweep
