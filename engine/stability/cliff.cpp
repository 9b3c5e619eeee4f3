#include "engine/stability/cliff.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

namespace {

/// The curve on both sides of a cliff that has been found.
void look_around(const Experiment& experiment, Cliff& cliff) {
  const auto [lowest, highest] = std::ranges::minmax(cliff.probes, {}, &Probe::step);
  std::vector<double> steps;
  for (double step = lowest.step / 2.0; step > 0.2 * cliff.stable; step /= 2.0) steps.push_back(step);
  for (const double factor : {kWalk, 2.0})
    if (factor * cliff.unstable > highest.step) steps.push_back(factor * cliff.unstable);
  for (const double step : steps) {
    const Probe probe = experiment(step);
    cliff.interrupted = probe.failure == Failure::interrupted;
    if (cliff.interrupted) return;
    cliff.probes.push_back(probe);
  }
}

/// Tries a step and moves the end of the bracket that it belongs to; false: interrupted.
bool try_step(const Experiment& experiment, double step, Cliff& cliff) {
  const Probe probe = experiment(step);
  cliff.interrupted = probe.failure == Failure::interrupted;
  if (cliff.interrupted) return false;
  cliff.probes.push_back(probe);
  if (probe.stable()) {
    cliff.stable = step;
  } else {
    cliff.unstable = step;
    cliff.failure = probe.failure;
  }
  return true;
}

void walk(const Experiment& experiment, double start, Cliff& cliff) {
  if (!try_step(experiment, start, cliff)) return;
  const bool up = cliff.stable > 0.0;
  const double factor = up ? kWalk : 1.0 / kWalk;
  for (int k = 1;
       k <= (up ? kLongestWalkUp : kLongestWalkDown) && !(cliff.stable > 0.0 && cliff.unstable > 0.0); ++k)
    if (!try_step(experiment, start * std::pow(factor, k), cliff)) return;
}

}  // namespace

const Probe* Cliff::last_stable() const {
  const auto found = std::ranges::find_if(
      probes, [this](const Probe& probe) { return probe.stable() && probe.step == stable; });
  return found == probes.end() ? nullptr : &*found;
}

Cliff find_cliff(const Experiment& experiment, const CliffSearch& search) {
  Cliff cliff;
  walk(experiment, search.start, cliff);
  while (!cliff.interrupted && cliff.stable > 0.0 && cliff.unstable > (1.0 + search.precision) * cliff.stable)
    try_step(experiment, std::sqrt(cliff.stable * cliff.unstable), cliff);
  if (!cliff.interrupted && cliff.stable > 0.0 && cliff.unstable > 0.0) look_around(experiment, cliff);
  std::ranges::sort(cliff.probes, {}, &Probe::step);
  return cliff;
}

}  // namespace repose
