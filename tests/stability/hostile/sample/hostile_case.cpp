#include "stability/hostile/sample/hostile_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/dynamics/time_step.hpp"
#include "engine/scene/names.hpp"
#include "engine/scene/scene_reader.hpp"

namespace repose::hostile {

namespace {

using Json = CaseDocument::Json;

constexpr double kDensity = 2500.0, kShearModulus = 1e7;
constexpr double kDiameter = 4.0;  // of a particle [mm]
/// CPU time that a case may take if all goes as foreseen [s], at so much a step and a step of one sphere, on
/// a slow core.
constexpr double kBudget = 1.0, kPerStep = 2e-6, kPerSphere = 1.2e-7;

constexpr std::uint64_t kSavingsStream = 1'000'000;  // beyond the attempts of a case

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t index, std::uint64_t attempt)
      : random_(mix64(seed) + index, attempt), bold_(kBoldness[index % kBoldness.size()]) {}

  /// Even in the sensible range, or now and then in the far one.
  double even(double low, double high, double far_low, double far_high) {
    const bool far = bold();
    const double u = random_.uniform();
    return far ? far_low + u * (far_high - far_low) : low + u * (high - low);
  }
  /// The same, even in the logarithm.
  double scale(double low, double high, double far_low, double far_high) {
    return std::exp(even(std::log(low), std::log(high), std::log(far_low), std::log(far_high)));
  }
  /// Whether a quantity leaves its sensible range.
  bool bold() { return random_.uniform() < bold_; }
  double uniform(double low, double high) { return random_.uniform(low, high); }
  template <class List>
  auto one_of(const List& list) {
    return list[random_.below(std::size(list))];
  }
  /// The word of a choice: the first where it stays sensible.
  template <class Choice>
  std::string choice() {
    const auto& names = kNames<Choice>;
    const auto any = random_.below(names.size());
    return std::string(names[bold() ? any : 0].name);
  }
  std::uint64_t next() { return random_.next(); }

 private:
  RandomStream random_;
  double bold_;
};

double sphere_volume(double diameter) { return kPi / 6.0 * diameter * diameter * diameter; }

/// Shapes with their sizes.
struct Grains {
  Json shapes, classes;
  double mean_volume = 0.0;  ///< by number [mm³]
  double span = 0.0;         ///< of the largest [mm]
};

Grains spheres_of_two_sizes(Draw& draw) {
  const double ratio = draw.uniform(2.0, 20.0), large = 2.0 * kDiameter, small = large / ratio;
  const double share = draw.uniform(20.0, 95.0);  // of the small ones, by number [%]
  Grains grains;
  grains.shapes = {{{"sphere", true}}};
  grains.classes = {{{"diameter_mm", small}, {"percent", share}},
                    {{"diameter_mm", large}, {"percent", 100.0 - share}}};
  grains.mean_volume = 0.01 * (share * sphere_volume(small) + (100.0 - share) * sphere_volume(large));
  grains.span = large;
  return grains;
}

Grains draw_grains(Draw& draw, const std::string& root) {
  const std::string own = root + "/tests/stability/hostile/shapes/";
  const std::array<std::string, 3> clumps{own + "pair.json", own + "plate.json",
                                          root + "/cases/shapes/particle_13.json"};
  const bool clump = draw.uniform(0.0, 1.0) < 0.4, tiny = draw.bold() && draw.uniform(0.0, 1.0) < 0.2;
  const bool two_sizes = draw.bold() && draw.uniform(0.0, 1.0) < 0.2;
  if (two_sizes) return spheres_of_two_sizes(draw);
  Grains grains;
  const std::string file = tiny ? own + "speck.json" : draw.one_of(clumps);
  grains.shapes = {clump || tiny ? Json{{"clump", file}} : Json{{"sphere", true}}};
  grains.mean_volume = sphere_volume(kDiameter);
  grains.classes = {{{"volume_mm3", {grains.mean_volume, grains.mean_volume}}, {"percent", 100.0}}};
  grains.span = clump ? 2.0 * kDiameter : 1.1 * kDiameter;
  return grains;
}

Json draw_contact(Draw& draw) {
  const auto friction = [&draw](double low, double high) {
    const double value = draw.scale(low, high, 0.005, 5.0);
    return draw.bold() && draw.uniform(0.0, 1.0) < 0.3 ? 0.0 : value;
  };
  const auto side = [&] {
    double e = draw.even(0.2, 0.7, 0.0, 1.0);
    if (draw.bold() && draw.uniform(0.0, 1.0) < 0.4) e = std::round(e);
    return Json{{"restitution", e},
                {"static_friction", friction(0.2, 0.9)},
                {"rolling_friction", friction(0.05, 0.3)}};
  };
  const auto rolling = std::string(draw.one_of(kNames<RollingModel>).name);
  return {{"particle_particle", side()},
          {"particle_wall", side()},
          {"rolling_model", rolling},
          {"tangential_history", draw.choice<TangentialHistory>()},
          {"normal_damping", draw.choice<NormalDamping>()},
          {"rolling_damping_ratio", draw.even(0.2, 0.4, 0.0, 2.0)},
          {"rolling_torque", draw.choice<RollingTorque>()}};
}

/// A cylinder for a column of `bodies` bodies that fills most of it, or that is too low for it.
Json draw_test(Draw& draw, const Grains& grains, double bodies) {
  const double bulk = bodies * grains.mean_volume / 0.55, slenderness = draw.uniform(0.7, 2.5);
  const double diameter =
      std::max(std::cbrt(4.0 * bulk / (kPi * slenderness)), draw.even(4.0, 6.0, 3.05, 12.0) * grains.span);
  const double column = 4.0 * bulk / (kPi * diameter * diameter);
  const double height =
      std::max(column * draw.even(1.6, 2.5, 0.8, 5.0) + 2.0 * grains.span, 1.1 * grains.span);
  const double mass = 1e-9 * bodies * grains.mean_volume * kDensity;
  Json test = {{"kind", std::string(draw.one_of(kNames<TestKind>).name)},
               {"cylinder", {{"diameter_mm", diameter}, {"height_mm", height}}},
               {"pour_rate_kg_s", mass / draw.scale(0.05, 0.3, 0.002, 2.0)},
               {"pour_speed_m_s", draw.even(0.3, 1.0, 0.0, 10.0)},
               {"opening_speed_m_s", draw.scale(0.3, 2.0, 0.01, 100.0)}};
  if (draw.uniform(0.0, 1.0) < 0.6)
    test["base"] = {{"diameter_mm", diameter * draw.even(1.5, 3.0, 1.0, 6.0)}};
  return test;
}

Json draw_case(Draw& draw, const std::string& root) {
  const Grains grains = draw_grains(draw, root);
  const double bodies = draw.scale(300.0, 500.0, 2.0, 400.0);
  Json json = {{"schema", 1},
               {"particles",
                {{"density_kg_m3", kDensity},
                 {"shear_modulus_Pa", kShearModulus},
                 {"poisson_ratio", 0.25},
                 {"shapes", grains.shapes},
                 {"size_classes", grains.classes},
                 {"total_mass_kg", 1e-9 * bodies * grains.mean_volume * kDensity}}},
               {"walls",
                {{"density_kg_m3", 1200},
                 {"shear_modulus_Pa", draw.scale(kShearModulus, kShearModulus, 1e5, 1e8)},
                 {"poisson_ratio", 0.4}}},
               {"contact", draw_contact(draw)},
               {"test", draw_test(draw, grains, bodies)}};
  json["numerics"] = {{"time_step_fraction", draw.scale(0.05, 0.2, 0.01, 5.0)},
                      {"stiffness_scale", draw.scale(0.1, 2.0, 1e-7, 10.0)},
                      {"integrator", draw.choice<Integrator>()},
                      {"stage_time_limit_s", draw.even(0.7, 1.0, 0.05, 1.0)}};
  return json;
}

/// Ways to save time that some cases take, from a stream of their own.
void add_savings(Json& json, RandomStream random) {
  const auto some = [&random] { return random.uniform() < 0.25; };
  Json &test = json["test"], &numerics = json["numerics"];
  if (some()) test["filling"] = random.uniform() < 0.5 ? "rain" : "packing";
  if (some()) test["opening"] = "instant";
  if (some())
    test["shared_columns"] = {{"count", 1 + random.below(3)},
                              {"restitution", random.uniform()},
                              {"static_friction", random.uniform(0.0, 2.0)},
                              {"rolling_friction", random.uniform(0.0, 1.0)}};
  if (some()) numerics["arithmetic"] = "mixed";
  if (some()) numerics["rest_angle_change_deg"] = random.uniform(0.05, 0.5);
  if (some()) json["particles"]["coarse_graining"] = random.uniform(1.0, 1.2);
}

/// CPU time of a run that neither stops early nor takes its stages' whole limits [s].
double foreseen_cost(const Scene& scene, double bodies) {
  const SlumpTest& test = scene.test;
  const double far =
      std::isinf(test.base_radius) ? 4.0 * test.cylinder_radius : test.base_radius + test.cylinder_radius;
  const double travel = test.kind == TestKind::split_cylinder ? far : test.cylinder_height;
  const double time = scene.particles.total_mass / test.pour_rate + travel / test.opening_speed +
                      0.6 * scene.numerics.stage_time_limit;
  std::size_t spheres = 1;
  for (const Clump& shape : scene.particles.shapes) spheres = std::max(spheres, shape.spheres.size());
  return time / time_step(scene) * (kPerStep + kPerSphere * bodies * static_cast<double>(spheres));
}

double bodies_of(const Scene& scene) {
  double volume = 0.0;
  for (const SizeClass& size : scene.particles.size_classes)
    volume += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
  return scene.particles.total_mass / (scene.particles.material.density * volume);
}

}  // namespace

HostileCase hostile_case(std::uint64_t seed, std::uint64_t index, const std::string& root) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    Draw draw(seed, index, attempt);
    HostileCase hostile{draw_case(draw, root), draw.next() % 1000};
    add_savings(hostile.json, RandomStream(mix64(seed) + index, kSavingsStream + attempt));
    hostile.json["title"] = "Hostile case " + std::to_string(index) + " of sample " + std::to_string(seed);
    Faults faults;
    const Scene scene = read_scene(CaseDocument::from_json(hostile.json, "case.json"), faults);
    if (!faults.empty() || foreseen_cost(scene, bodies_of(scene)) < kBudget) return hostile;
  }
}

HostileCase with_a_quarter_of_the_step(HostileCase hostile) {
  Json& fraction = hostile.json["numerics"]["time_step_fraction"];
  fraction = 0.25 * fraction.get<double>();
  return hostile;
}

}  // namespace repose::hostile
