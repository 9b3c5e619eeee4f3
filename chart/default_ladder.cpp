#include "chart/default_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/case_keys.hpp"
#include "engine/scene/scene_reader.hpp"
#include "engine/scene/tidy_path.hpp"

namespace repose::chart {

namespace {

using Json = CaseDocument::Json;

constexpr const char* kFilledIn = sweep::kDefaultLadder;

double number_at(const CaseDocument& document, const char* pointer, double otherwise) {
  const Json* value = document.find(pointer);
  return value != nullptr && value->is_number() ? value->get<double>() : otherwise;
}

/// The default rungs of a case that reads as a scene.
class Rungs {
 public:
  Rungs(const CaseDocument& ground, const Scene& scene) : ground_(ground), scene_(scene) {
    add_steps();
    add_stiffnesses();
    for (const double share : {0.75, 0.5})
      add(fmt::format("mass × {}", share),
          {{"/particles/total_mass_kg", share * scene_.particles.total_mass}});
    if (scene_.test.filling == Filling::pour) {
      add("rain", {{"/test/filling", "rain"}});
      add("packing", {{"/test/filling", "packing"}});
    }
    if (!scene_.test.shared_columns) add("5 shared columns", {{"/test/shared_columns/count", 5}});
    for (const double factor : {10.0, 100.0})
      add(fmt::format("rest × {:.0f}", factor),
          {{"/numerics/settle_energy_ratio", factor * scene_.numerics.settle_energy_ratio},
           {"/numerics/rest_energy_ratio", factor * scene_.numerics.rest_energy_ratio}});
    if (!scene_.numerics.rest_angle_change)
      add("still angle 0.25°", {{"/numerics/rest_angle_change_deg", 0.25}});
    if (scene_.test.opening == Opening::moved) {
      add("opening × 3", {{"/test/opening_speed_m_s", 3.0 * scene_.test.opening_speed}});
      add("instant opening", {{"/test/opening", "instant"}});
    }
    if (scene_.numerics.arithmetic == Arithmetic::double_precision)
      add("mixed arithmetic", {{"/numerics/arithmetic", "mixed"}});
    add_sizes();
    add_shapes();
  }

  [[nodiscard]] Json take() { return std::move(rungs_); }

 private:
  /// Adds a rung if the case is sound with it.
  void add(const std::string& name, const Json& set) {
    CaseDocument document = ground_;
    Faults faults;
    try {
      for (const auto& [pointer, value] : set.items()) document.set(pointer, value, kFilledIn);
      read_scene(document, faults, shapes_);
    } catch (const InputError& error) {
      faults.add(error);
    }
    if (faults.empty()) rungs_.push_back({{"name", name}, {"set", set}});
  }

  void add_steps() {
    for (const double factor : {1.5, 2.0, 3.0}) {
      if (scene_.numerics.time_step)
        add(fmt::format("step × {}", factor),
            {{"/numerics/time_step_s", factor * *scene_.numerics.time_step}});
      else if (scene_.numerics.time_step_fraction)
        add(fmt::format("step {:.3g} T_R", factor * *scene_.numerics.time_step_fraction),
            {{"/numerics/time_step_fraction", factor * *scene_.numerics.time_step_fraction}});
    }
  }

  /// A step in seconds grows with the time that a softer contact lasts, as a fraction of T_R does by itself.
  void add_stiffnesses() {
    for (const double factor : {0.1, 0.01, 0.001}) {
      Json set = {{"/numerics/stiffness_scale", factor * scene_.numerics.stiffness_scale}};
      if (scene_.numerics.time_step)
        set["/numerics/time_step_s"] = *scene_.numerics.time_step / std::sqrt(factor);
      add(fmt::format("stiffness × {}", factor), set);
    }
  }

  void add_sizes() {
    const double grain = number_at(ground_, "/particles/coarse_graining", 1.0);
    for (const double factor : {1.25, 1.5, 2.0})
      add(fmt::format("grain × {}", factor), {{"/particles/coarse_graining", factor * grain}});
    const auto& classes = scene_.particles.size_classes;
    if (classes.empty() || (classes.size() == 1 && classes.front().volume_min == classes.front().volume_max))
      return;
    double mean = 0.0;  // by number, so that there are as many particles as before
    for (const SizeClass& size : classes)
      mean += size.number_fraction * 0.5 * (size.volume_min + size.volume_max);
    const double mm3 = 1e9 * mean / std::pow(grain, 3);
    add("one size", {{"/particles/size_classes", {{{"volume_mm3", {mm3, mm3}}, {"percent", 100}}}}});
  }

  void add_shapes() {
    const Json& shapes = ground_.json().at("particles").at("shapes");
    bool only_meshes = true, only_spheres = true;
    int most = 0;
    for (const Json& shape : shapes) {
      only_meshes = only_meshes && shape.contains("spheres");
      only_spheres = only_spheres && shape.contains("sphere");
      if (shape.contains("spheres")) most = std::max(most, shape.at("spheres").get<int>());
    }
    for (const int spheres : {20, 12, 8, 5}) {
      if (!only_meshes || spheres >= most) continue;
      Json set;
      for (std::size_t i = 0; i < shapes.size(); ++i)
        set[fmt::format("/particles/shapes/{}/spheres", i)] =
            std::min(spheres, shapes[i].at("spheres").get<int>());
      add(fmt::format("{} spheres", spheres), set);
    }
    if (shapes.size() > 1) add("one shape", {{"/particles/shapes", {absolute(0)}}});
    if (!only_spheres) add("spheres", {{"/particles/shapes", {sphere()}}});
  }

  /// The entry of a shape, found from anywhere.
  [[nodiscard]] Json absolute(std::size_t index) const {
    Json shape = ground_.json().at("particles").at("shapes").at(index);
    for (const char* key : {"clump", "mesh"}) {
      if (!shape.contains(key)) continue;
      const std::string pointer = fmt::format("/particles/shapes/{}/{}", index, key);
      shape[key] =
          tidy(std::filesystem::absolute(ground_.resolve(pointer, shape[key].get<std::string>()))).string();
    }
    return shape;
  }

  /// Of the mean volume where no size classes give it.
  [[nodiscard]] Json sphere() const {
    Json shape = {{"sphere", true}};
    if (!scene_.particles.size_classes.empty()) return shape;
    double volume = 0.0;
    for (const Clump& clump : scene_.particles.shapes)
      volume += clump.volume / static_cast<double>(scene_.particles.shapes.size());
    const double grain = number_at(ground_, "/particles/coarse_graining", 1.0);
    shape["diameter_mm"] = 1e3 * std::cbrt(6.0 * volume / kPi) / grain;
    return shape;
  }

  const CaseDocument& ground_;
  const Scene& scene_;
  ShapeCache shapes_;
  Json rungs_ = Json::array();
};

/// The case with what its ladder's reference, first set of frictions and working point set; faults are left
/// to the sweep, which names them.
std::optional<CaseDocument> ground_of(const CaseDocument& document) {
  CaseDocument ground = document;
  Faults faults;
  try {
    CaseDocument readable = document;
    if (document.find("/chart/rungs") == nullptr) readable.set("/chart/rungs", Json::array(), kFilledIn);
    const sweep::Ladder ladder = sweep::read_ladder(readable, faults);
    const auto set = [&](const sweep::Variant& variant) {
      for (const sweep::Override& override : variant.set)
        ground.set(override.pointer, sweep::with_absolute_paths(document, override), override.place);
    };
    set(ladder.reference);
    if (!ladder.frictions.empty())
      for (std::size_t f = 0; f < ladder.friction_names.size(); ++f)
        if (const auto pointer = factor_pointer(ladder.friction_names[f]))
          ground.set(*pointer, ladder.frictions.front()[f], kFilledIn);
    if (ladder.has_working_point) set(ladder.rungs.front());
    faults = {};
    read_scene(ground, faults);
  } catch (const InputError&) {
    return std::nullopt;
  }
  if (!faults.empty()) return std::nullopt;
  return ground;
}

}  // namespace

CaseDocument with_chart(const CaseDocument& document) {
  CaseDocument chart = document;
  const Json* given = document.find("/chart");
  if (given != nullptr && !given->is_object()) {
    chart.set("/sweep", {{"design", "chart"}}, kFilledIn);
    return chart;
  }
  if (given == nullptr) chart.set("/chart", Json::object(), kFilledIn);
  if (chart.find("/chart/frictions") == nullptr)
    chart.set("/chart/frictions",
              Json::array({{{"mu_s", 0.2}, {"mu_r", 0.05}},
                           {{"mu_s", 0.5}, {"mu_r", 0.1}},
                           {{"mu_s", 0.8}, {"mu_r", 0.2}}}),
              kFilledIn);
  if (chart.find("/chart/rungs") == nullptr) {
    Json rungs = Json::array();
    if (const auto ground = ground_of(chart)) rungs = Rungs(*ground, read_scene(*ground)).take();
    chart.set("/chart/rungs", rungs, kFilledIn);
  }
  chart.set("/sweep", {{"design", "chart"}}, kFilledIn);
  return chart;
}

CaseDocument with_rungs(const CaseDocument& chart, const std::vector<sweep::Variant>& rungs) {
  Json list = *chart.find("/chart/rungs");
  for (const sweep::Variant& rung : rungs) {
    Json set = Json::object();
    for (const sweep::Override& override : rung.own()) set[override.pointer] = override.value;
    list.push_back({{"name", rung.name}, {"set", std::move(set)}});
  }
  CaseDocument longer = chart;
  longer.set("/chart/rungs", std::move(list), chart.source("/chart/rungs"));
  return longer;
}

}  // namespace repose::chart
