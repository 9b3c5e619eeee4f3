#include "tools/program/heap_gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "engine/base/vec3.hpp"
#include "sweep/plan.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"
#include "tools/report/heap_plot.hpp"
#include "tools/report/profile_plot.hpp"

namespace repose::program {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "heaps";

/// How far an angle is from the lowest, the nearest and the highest, as numbers to be made small.
std::array<double, 3> ranks_of(double angle, double measured) {
  return {angle, std::abs(angle - measured), -angle};
}

std::string caption_of(const ShownRun& shown) {
  const sweep::StoredRun& run = shown.run;
  return fmt::format("{}: {:.1f}° with e_pp = {:.3g}, mu_s = {:.3g}, mu_r = {:.3g} (replicate {})", shown.why,
                     run.angle_deg.value_or(0.0), run.e_pp, run.mu_s, run.mu_r, run.replicate);
}

/// The scene of a stored run; nothing where it would not be the same run any more.
const Scene* scene_of(const sweep::Plan& plan, const sweep::StoredRun& run) {
  const auto planned = std::find_if(plan.runs.begin(), plan.runs.end(),
                                    [&](const sweep::PlannedRun& other) { return other.key == run.run_key; });
  return planned == plan.runs.end() ? nullptr : &plan.points[planned->point].scene;
}

/// Simulates runs again, all at a time; no heap for a run that cannot be or that was interrupted.
std::vector<std::optional<HeapSnapshot>> simulate_again(const sweep::Study& study,
                                                        const std::vector<const ShownRun*>& runs,
                                                        bool quiet) {
  std::vector<std::optional<HeapSnapshot>> heaps(runs.size());
  if (runs.empty()) return heaps;
  ProgressLine line(quiet);
  line.show_now(fmt::format("simulating {} of the heaps again for their pictures", runs.size()));
  const sweep::Plan plan = sweep::make_plan(study.document);
  std::vector<std::future<std::optional<HeapSnapshot>>> futures;
  for (const ShownRun* shown : runs)
    futures.push_back(std::async(std::launch::async, [&plan, shown]() -> std::optional<HeapSnapshot> {
      const Scene* scene = scene_of(plan, shown->run);
      if (scene == nullptr) return std::nullopt;
      RunOptions options;
      options.stop = &watch_for_interrupt();
      RunResult result = run_slump_test(*scene, static_cast<std::uint64_t>(shown->run.seed), options);
      if (result.outcome != Outcome::completed) return std::nullopt;
      return std::move(result.heap);
    }));
  std::transform(futures.begin(), futures.end(), heaps.begin(), [](auto& future) { return future.get(); });
  return heaps;
}

/// The side profiles of a run as they were read when it ran.
void draw_profile(const sweep::Study& study, const ShownRun& shown, const fs::path& picture) {
  const auto flanks = study.store.flanks(shown.run.run_key);
  if (!flanks || fs::exists(picture)) return;
  HeapMeasurement measurement;
  measurement.has_heap = true;
  measurement.flanks = *flanks;
  measurement.angle = radians(shown.run.angle_deg.value_or(0.0));
  measurement.standard_error = radians(shown.run.angle_standard_error_deg.value_or(0.0));
  plot_profiles(measurement, picture, "");
}

}  // namespace

void HeapKeeper::see(const sweep::StoredRun& run, const RunResult& result) {
  if (!run.completed() || !run.angle_deg) return;
  const std::array<double, 3> ranks = ranks_of(*run.angle_deg, measured_);
  for (std::size_t i = 0; i < kept_.size(); ++i)
    if (!kept_[i] || ranks[i] < kept_[i]->rank) kept_[i] = Kept{run.run_key, ranks[i], result.heap};
}

const HeapSnapshot* HeapKeeper::heap_of(const std::string& run_key) const {
  for (const auto& kept : kept_)
    if (kept && kept->run_key == run_key) return &kept->heap;
  return nullptr;
}

std::vector<ShownRun> runs_to_show(const std::vector<sweep::StoredRun>& runs,
                                   std::optional<double> measured) {
  constexpr std::array<const char*, 3> kWhy = {"lowest angle", "nearest to the measured angle",
                                               "highest angle"};
  std::array<const sweep::StoredRun*, 3> best = {};
  std::array<double, 3> rank = {};
  for (const sweep::StoredRun& run : runs) {
    if (!run.completed() || !run.angle_deg || !run.point || run.superseded) continue;
    const std::array<double, 3> ranks = ranks_of(*run.angle_deg, measured.value_or(0.0));
    for (std::size_t i = 0; i < best.size(); ++i)
      if (best[i] == nullptr || ranks[i] < rank[i]) best[i] = &run, rank[i] = ranks[i];
  }
  std::vector<ShownRun> shown;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i] == nullptr || (i == 1 && !measured)) continue;
    const auto same = std::find_if(shown.begin(), shown.end(), [&](const ShownRun& other) {
      return other.run.run_key == best[i]->run_key;
    });
    if (same != shown.end())
      same->why += std::string(", ") + kWhy[i];
    else
      shown.push_back({*best[i], kWhy[i]});
  }
  return shown;
}

std::vector<report::Picture> draw_heaps(const sweep::Study& study, const std::vector<ShownRun>& shown,
                                        const HeapKeeper* keeper, bool quiet) {
  const fs::path folder = study.folder / kFolder;
  const auto picture_of = [&](const ShownRun& run) { return folder / (run.run.run_key + ".png"); };
  make_folder(folder);
  std::vector<const ShownRun*> again;
  for (const ShownRun& run : shown) {
    if (fs::exists(picture_of(run))) continue;
    const HeapSnapshot* heap = keeper == nullptr ? nullptr : keeper->heap_of(run.run.run_key);
    if (heap != nullptr)
      plot_heap(*heap, picture_of(run));
    else
      again.push_back(&run);
  }
  const auto heaps = simulate_again(study, again, quiet);
  for (std::size_t i = 0; i < again.size(); ++i)
    if (heaps[i]) plot_heap(*heaps[i], picture_of(*again[i]));

  std::vector<report::Picture> pictures;
  for (const ShownRun& run : shown) {
    const fs::path profile = folder / (run.run.run_key + "_profile.png");
    draw_profile(study, run, profile);
    if (fs::exists(picture_of(run))) pictures.push_back({picture_of(run), caption_of(run)});
    if (fs::exists(profile)) pictures.push_back({profile, "side profiles and flanks, " + run.why});
  }
  return pictures;
}

}  // namespace repose::program
