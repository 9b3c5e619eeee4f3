#include "engine/stability/probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace repose {

const char* name_of(Failure failure) {
  switch (failure) {
    case Failure::none:
      return "none";
    case Failure::energy:
      return "energy";
    case Failure::overlap:
      return "overlap";
    case Failure::escaped:
      return "escaped";
    case Failure::diverged:
      return "diverged";
    case Failure::interrupted:
      return "interrupted";
  }
  return "unknown";
}

Failure judge(const Probe& probe, const Tolerance& tolerance) {
  if (!std::isfinite(probe.energy_error) || !std::isfinite(probe.overlap)) return Failure::diverged;
  if (std::abs(probe.energy_error) > tolerance.energy) return Failure::energy;
  if (probe.overlap > 1.0 + tolerance.overlap) return Failure::overlap;
  return Failure::none;
}

Probe watch_steps(Simulation& simulation, const Watched& watched) {
  Probe probe;
  probe.step = simulation.dt();
  const auto steps = static_cast<long>(std::ceil(watched.duration / probe.step));
  const auto per_look = std::max(1L, static_cast<long>(watched.look_interval / probe.step));
  EnergyLedger before;
  for (long done = 0; done < steps;) {
    const long next = done == 0 ? 1 : std::min(steps, done + per_look);
    for (; done < next; ++done)
      if (!simulation.step()) {
        probe.energy_error = std::numeric_limits<double>::infinity();
        probe.failure = Failure::diverged;
        return probe;
      }
    // Contacts that stand at the beginning are found by the first step.
    if (done == 1) before = simulation.ledger();
    const double error = (simulation.ledger().imbalance() - before.imbalance()) / watched.energy;
    if (!(std::abs(error) <= std::abs(probe.energy_error))) probe.energy_error = error;
    probe.overlap = std::max(probe.overlap, simulation.survey().largest_overlap / watched.overlap);
    if (!(std::abs(probe.energy_error) <= kHopeless)) break;
    if (watched.stop && watched.stop->load(std::memory_order_relaxed)) {
      probe.failure = Failure::interrupted;
      return probe;
    }
  }
  probe.failure = judge(probe, watched.tolerance);
  return probe;
}

}  // namespace repose
