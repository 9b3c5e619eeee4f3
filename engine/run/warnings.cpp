#include "engine/run/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/dynamics/time_step.hpp"
#include "engine/scene/particle_sizes.hpp"

namespace repose {

namespace {

/// Smallest and largest diameter of the spheres of equal volume that a scene pours [m].
struct Sizes {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
};

Sizes sizes_of(const Particles& particles) {
  Sizes sizes;
  const auto take = [&sizes](double volume) {
    const double diameter = std::cbrt(6.0 * volume / kPi);
    sizes.least = std::min(sizes.least, diameter);
    sizes.most = std::max(sizes.most, diameter);
  };
  for (const SizeClass& size : particles.size_classes) take(size.volume_min), take(size.volume_max);
  if (particles.size_classes.empty())
    for (const Clump& shape : particles.shapes) take(shape.volume);
  return sizes;
}

struct NamedContact {
  const char* words;
  const ContactParameters& contact;
};
std::array<NamedContact, 2> contacts_of(const Scene& scene) {
  return {{{"between particles", scene.contact.particle_particle},
           {"between particle and wall", scene.contact.particle_wall}}};
}

/// "μs = 3 between particles, μr = 2 between particle and wall": the values that a rule picks.
template <class Picks>
std::string picked(const Scene& scene, Picks picks) {
  std::string text;
  for (const auto& [words, contact] : contacts_of(scene))
    for (const auto& [symbol, value] : picks(contact))
      text += fmt::format("{}{} = {:.4g} {}", text.empty() ? "" : ", ", symbol, value, words);
  return text;
}
using Picked = std::vector<std::pair<const char*, double>>;

void warn_of_friction(const Scene& scene, std::vector<Warning>& warnings) {
  constexpr double kHighest = 1.0;
  const std::string high = picked(scene, [](const ContactParameters& contact) {
    Picked values;
    if (contact.static_friction > kHighest) values.emplace_back("μs", contact.static_friction);
    if (contact.rolling_friction > kHighest) values.emplace_back("μr", contact.rolling_friction);
    return values;
  });
  if (!high.empty())
    warnings.push_back(
        {"high_friction", high + ": friction above 1 is rare in dry materials and the angle hardly "
                                 "depends on it any more; check the value, or the shape instead"});
  const std::string none = picked(scene, [](const ContactParameters& contact) {
    return contact.static_friction == 0.0 ? Picked{{"μs", 0.0}} : Picked{};
  });
  if (!none.empty())
    warnings.push_back(
        {"no_friction", none + ": without sliding friction a heap slides apart, and a power law of μs "
                               "cannot take it; give a small value"});
  if (scene.contact.particle_particle.rolling_friction == 0.0)
    warnings.push_back(
        {"no_rolling_friction",
         "μr = 0 between particles: spheres roll away without it, only the shape of clumps holds them; "
         "a power law of μr cannot take it, give a small value"});
}

void warn_of_restitution(const Scene& scene, std::vector<Warning>& warnings) {
  const auto exactly = [&scene](double e) {
    return picked(scene, [e](const ContactParameters& contact) {
      return contact.restitution == e ? Picked{{"e", e}} : Picked{};
    });
  };
  if (const std::string none = exactly(0.0); !none.empty())
    warnings.push_back(
        {"no_restitution", none + ": contacts are damped critically, which needs a step several times "
                                  "smaller than e = 0.3 does; e = 0.05 gives the same heap"});
  if (const std::string full = exactly(1.0); !full.empty())
    warnings.push_back(
        {"full_restitution", full + ": nothing but friction takes energy out of contacts, and the heap "
                                    "may never rest; use 0.95 or less"});
}

void warn_of_sizes(const Scene& scene, std::vector<Warning>& warnings) {
  constexpr double kTiny = 0.1, kWidest = 10.0;
  for (const Clump& shape : scene.particles.shapes) {
    const double ratio = 2.0 * shape.smallest_radius() / shape.equivalent_diameter();
    if (ratio >= kTiny) continue;
    warnings.push_back({"tiny_sphere", fmt::format("the smallest sphere of {} has {:.2g} times the radius of "
                                                   "the sphere of its volume (bar: {:.2g}): "
                                                   "a step by its Rayleigh time costs {:.0f} times as many "
                                                   "steps, and it yields {:.1f} times as far "
                                                   "under a load; make the clump without it",
                                                   shape.name.empty() ? "a clump" : shape.name, ratio, kTiny,
                                                   1.0 / ratio, std::cbrt(1.0 / ratio))});
    break;
  }
  for (const Clump& shape : scene.particles.shapes) {
    const int groups = shape.groups();
    if (groups < 2) continue;
    warnings.push_back(
        {"loose_spheres",
         fmt::format("{} is {} groups of spheres with gaps between them: other particles can pass "
                     "through and hook into it; give it more spheres",
                     shape.name.empty() ? "a clump" : shape.name, groups)});
    break;
  }
  const Sizes sizes = sizes_of(scene.particles);
  if (sizes.most > kWidest * sizes.least)
    warnings.push_back(
        {"size_ratio", fmt::format("diameters from {:.3g} to {:.3g} mm, a ratio of {:.1f} (bar: {:.0f}): "
                                   "fine particles run through the coarse ones and the few large ones "
                                   "decide the angle; leave the fines out, or average over seeds",
                                   1e3 * sizes.least, 1e3 * sizes.most, sizes.most / sizes.least, kWidest)});
}

void warn_of_opening(const Scene& scene, std::vector<Warning>& warnings) {
  if (scene.test.opening == Opening::instant) return;
  constexpr double kShare = 0.1;
  const double step = time_step(scene) * scene.test.opening_speed;
  const double radius = smallest_sphere(scene.particles);
  if (step > kShare * radius)
    warnings.push_back(
        {"coarse_opening", fmt::format("the walls move by {:.2g} radii of the smallest sphere in a step "
                                       "(bar: {:.2g}): their contacts are not resolved while they leave; "
                                       "open more slowly, {:.3g} m/s, or use a smaller step",
                                       step / radius, kShare, kShare * radius / time_step(scene))});
}

/// Column's height above the base [m].
double height_of(const HeapSnapshot& column) {
  double height = 0.0;
  for (const SphereSnapshot& sphere : column.spheres)
    height = std::max(height, sphere.centre.z() + sphere.radius);
  return height;
}

/// The speed of the opening against √(g h), that of a fall from half the column's height: above 0.4 a column
/// collapses as if its walls had vanished, below the walls lead it (Sarlin, Morize, Sauret & Gondret 2021;
/// the article's 0.5 m/s, above which its angle varies little, is 0.37). Beyond 5 the walls tear particles
/// along: README.md has the figures.
void warn_of_speed(const Scene& scene, double height, std::vector<Warning>& warnings) {
  if (scene.test.opening == Opening::instant) return;
  constexpr double kSlow = 0.4, kFast = 5.0;
  const double fall = std::sqrt(kGravity * height);
  const double speed = scene.test.opening_speed;
  if (!(fall > 0.0)) return;
  if (speed < kSlow * fall)
    warnings.push_back(
        {"slow_opening",
         fmt::format("opened at {:.3g} m/s, {:.2g} √(g h) of the column (bar: {:.2g}): the walls lead "
                     "the collapse and the angle depends on their speed; give the experiment's own, or "
                     "{:.2g} m/s and more",
                     speed, speed / fall, kSlow, kSlow * fall)});
  if (speed > kFast * fall)
    warnings.push_back(
        {"fast_opening",
         fmt::format("opened at {:.3g} m/s, {:.2g} √(g h) of the column (bar: {:.2g}): the walls tear "
                     "particles along and more leave the base; give the experiment's own speed, or {:.2g} "
                     "m/s and less",
                     speed, speed / fall, kFast, kFast * fall)});
}

}  // namespace

std::vector<Warning> scene_warnings(const Scene& scene) {
  std::vector<Warning> warnings;
  warn_of_friction(scene, warnings);
  warn_of_restitution(scene, warnings);
  warn_of_sizes(scene, warnings);
  warn_of_opening(scene, warnings);
  return warnings;
}

std::vector<Warning> run_warnings(const Scene& scene, const SlumpTestRun& run) {
  std::vector<Warning> warnings = run.warnings();
  const MotionDiagnosis& motion = run.diagnosis();
  if (motion.stability_number > motion.coarse)
    warnings.push_back(
        {"coarse_step", fmt::format("the step's stability number reached {:.1f} (bar: {:.0f}): bodies may "
                                    "jitter or gain energy; use a step of {:.2g} s or less",
                                    motion.stability_number, motion.coarse,
                                    run.simulation().dt() * motion.coarse / motion.stability_number)});
  if (std::abs(motion.energy_imbalance) > MotionDiagnosis::kLargeImbalance)
    warnings.push_back(
        {"energy_error",
         fmt::format("the energy ledger was off by {:+.0f} % of what was put in (bar: {:.0f} %; "
                     "at {:.0f} % the run ends): use a smaller step",
                     100.0 * motion.energy_imbalance, 100.0 * MotionDiagnosis::kLargeImbalance,
                     100.0 * MotionDiagnosis::kMostImbalance)});
  if (motion.column_overlap_ratio > MotionDiagnosis::kSoft)
    warnings.push_back(
        {"soft_contacts",
         fmt::format("particles of the settled column overlap by {:.2g} % of their "
                     "diameter in the mean (bar: {:.2g} %): the column is about {:.0f} % "
                     "too dense; raise /numerics/stiffness_scale or the shear modulus",
                     100.0 * motion.column_overlap_ratio, 100.0 * MotionDiagnosis::kSoft,
                     100.0 * MotionDiagnosis::kDensityPerOverlap * motion.column_overlap_ratio)});
  if (motion.spilled > 0)
    warnings.push_back(
        {"spilled", fmt::format("{} bodies ({:.2g} kg) bounced over the cylinder's rim and were taken "
                                "away; use a higher cylinder, or pour more slowly",
                                motion.spilled, motion.spilled_mass)});
  warn_of_speed(scene, height_of(run.column()), warnings);
  return warnings;
}

}  // namespace repose
