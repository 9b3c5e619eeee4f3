#include "engine/scene/canonical.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/scene/names.hpp"

namespace repose {

namespace {

using Json = nlohmann::ordered_json;

// Every struct is taken apart by structured bindings: a member that is added to one does not build here until
// it is written as well, so that no input can be forgotten in a run's key.

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const Material& material) {
  const auto& [density, shear_modulus, poisson_ratio] = material;
  return {{"density", density}, {"shear_modulus", shear_modulus}, {"poisson_ratio", poisson_ratio}};
}

Json json_of(const Clump& clump) {
  const auto& [name, spheres, volume, inertia] = clump;
  static_cast<void>(name);
  Json list = Json::array();
  for (const auto& [centre, radius] : spheres)
    list.push_back(Json::array({centre.x(), centre.y(), centre.z(), radius}));
  return {{"volume", volume}, {"inertia", json_of(inertia)}, {"spheres", std::move(list)}};
}

Json json_of(const Particles& particles) {
  const auto& [material, shapes, size_classes, total_mass] = particles;
  Json shape_list = Json::array();
  for (const Clump& shape : shapes) shape_list.push_back(json_of(shape));
  Json class_list = Json::array();
  for (const auto& [volume_min, volume_max, number_fraction] : size_classes)
    class_list.push_back(Json::array({volume_min, volume_max, number_fraction}));
  return {{"material", json_of(material)},
          {"shapes", std::move(shape_list)},
          {"size_classes", std::move(class_list)},
          {"total_mass", total_mass}};
}

Json json_of(const ContactParameters& parameters) {
  const auto& [restitution, static_friction, rolling_friction] = parameters;
  return {{"restitution", restitution},
          {"static_friction", static_friction},
          {"rolling_friction", rolling_friction}};
}

Json json_of(const ContactModel& contact) {
  const auto& [particle_particle, particle_wall, rolling_model, tangential_history, normal_damping,
               rolling_damping_ratio, rolling_torque] = contact;
  return {{"particle_particle", json_of(particle_particle)},
          {"particle_wall", json_of(particle_wall)},
          {"rolling_model", choice_name(rolling_model)},
          {"tangential_history", choice_name(tangential_history)},
          {"normal_damping", choice_name(normal_damping)},
          {"rolling_damping_ratio", rolling_damping_ratio},
          {"rolling_torque", choice_name(rolling_torque)}};
}

Json json_of(const SlumpTest& test) {
  const auto& [kind, filling, opening, base_radius, base_height, cylinder_radius, cylinder_height, pour_rate,
               pour_speed, opening_speed, shared_columns] = test;
  const Json radius = std::isfinite(base_radius) ? Json(base_radius) : Json("unbounded");
  Json json = {{"kind", choice_name(kind)},          {"filling", choice_name(filling)},
               {"opening", choice_name(opening)},    {"base_radius", radius},
               {"base_height", base_height},         {"cylinder_radius", cylinder_radius},
               {"cylinder_height", cylinder_height}, {"pour_rate", pour_rate},
               {"pour_speed", pour_speed},           {"opening_speed", opening_speed}};
  if (shared_columns) {  // written only where they are: older studies keep their runs
    const auto& [count, contact] = *shared_columns;
    json["shared_columns"] = {{"count", count}, {"contact", json_of(contact)}};
  }
  return json;
}

Json json_of(const Numerics& numerics) {
  const auto& [time_step_fraction, time_step, stiffness_scale, integrator, arithmetic, settle_energy_ratio,
               rest_energy_ratio, rest_angle_change, stage_time_limit] = numerics;
  Json json = {{"time_step_fraction", time_step_fraction ? Json(*time_step_fraction) : Json()},
               {"time_step", time_step ? Json(*time_step) : Json()},
               {"stiffness_scale", stiffness_scale},
               {"integrator", choice_name(integrator)},
               {"settle_energy_ratio", settle_energy_ratio},
               {"rest_energy_ratio", rest_energy_ratio},
               {"rest_angle_change", rest_angle_change ? Json(*rest_angle_change) : Json()},
               {"stage_time_limit", stage_time_limit}};
  // Written only where it is another than all versions before it had: their studies keep their runs.
  if (arithmetic != Arithmetic::double_precision) json["arithmetic"] = choice_name(arithmetic);
  return json;
}

Json json_of(const MeasureOptions& measure) {
  const auto& [window_low, window_high] = measure;
  return {{"window_low", window_low}, {"window_high", window_high}};
}

}  // namespace

std::string canonical_text(const Scene& scene) {
  const auto& [title, particles, walls, contact, test, numerics, measure] = scene;
  static_cast<void>(title);
  const Json json = {{"particles", json_of(particles)}, {"walls", json_of(walls)},
                     {"contact", json_of(contact)},     {"test", json_of(test)},
                     {"numerics", json_of(numerics)},   {"measure", json_of(measure)}};
  return json.dump();
}

std::string digest(const std::string& text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace repose
