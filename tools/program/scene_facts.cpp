#include "tools/program/scene_facts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "engine/scene/names.hpp"

namespace repose::program {

using report::Fact;
using report::FactGroup;

namespace {

std::vector<Fact> material_facts(const Material& material) {
  return {{"density", fmt::format("{:.6g} kg/m³", material.density)},
          {"shear modulus", fmt::format("{:.4g} MPa", material.shear_modulus * 1e-6)},
          {"Poisson's ratio", fmt::format("{:.4g}", material.poisson_ratio)}};
}

std::string words_of(const ContactParameters& contact) {
  return fmt::format("restitution {:.4g}, static friction {:.4g}, rolling friction {:.4g}",
                     contact.restitution, contact.static_friction, contact.rolling_friction);
}

std::string words_of(const Clump& shape) {
  if (shape.spheres.size() == 1) return shape.name.empty() ? "sphere" : shape.name;
  return fmt::format("{}{} spheres", shape.name.empty() ? "" : shape.name + ", ", shape.spheres.size());
}

std::string words_of(const SizeClass& size) {
  const std::string share = fmt::format(": {:.4g} % by number", 100.0 * size.number_fraction);
  if (size.volume_min == size.volume_max)
    return fmt::format("diameter {:.4g} mm", 1e3 * std::cbrt(6.0 * size.volume_min / kPi)) + share;
  return fmt::format("{:.4g} … {:.4g} mm³", 1e9 * size.volume_min, 1e9 * size.volume_max) + share;
}

std::vector<Fact> particle_facts(const Particles& particles) {
  std::vector<Fact> facts = material_facts(particles.material);
  for (const Clump& shape : particles.shapes) facts.push_back({"shape", words_of(shape)});
  for (const SizeClass& size : particles.size_classes) facts.push_back({"size", words_of(size)});
  facts.push_back({"mass", fmt::format("{:.4g} kg", particles.total_mass)});
  return facts;
}

std::vector<Fact> test_facts(const SlumpTest& test) {
  const bool plane = std::isinf(test.base_radius);
  return {{"kind", std::string(choice_name(test.kind))},
          {"base", plane ? "unbounded plane"
                         : fmt::format("diameter {:.4g} mm, height {:.4g} mm", 2e3 * test.base_radius,
                                       1e3 * test.base_height)},
          {"cylinder", fmt::format("inner diameter {:.4g} mm, height {:.4g} mm", 2e3 * test.cylinder_radius,
                                   1e3 * test.cylinder_height)},
          {"filling", test.filling == Filling::pour ? fmt::format("poured at {:.4g} kg/s", test.pour_rate)
                                                    : std::string(choice_name(test.filling))},
          {"opened",
           test.opening == Opening::instant ? "at once" : fmt::format("at {:.4g} m/s", test.opening_speed)}};
}

std::vector<Fact> numerics_facts(const Numerics& numerics) {
  const std::string step = numerics.time_step_fraction
                               ? fmt::format("{:.4g} of the Rayleigh time", *numerics.time_step_fraction)
                           : numerics.time_step ? fmt::format("{:.4g} µs", 1e6 * *numerics.time_step)
                                                : "chosen by the program";
  return {{"time step", step}, {"stiffness scale", fmt::format("{:.4g}", numerics.stiffness_scale)}};
}

}  // namespace

std::vector<FactGroup> facts_of(const Scene& scene) {
  return {{"Particles", particle_facts(scene.particles)},
          {"Walls", material_facts(scene.walls)},
          {"Contact",
           {{"between particles, where not varied", words_of(scene.contact.particle_particle)},
            {"particle and wall", words_of(scene.contact.particle_wall)},
            {"rolling model", std::string(choice_name(scene.contact.rolling_model))}}},
          {"Test", test_facts(scene.test)},
          {"Numerics", numerics_facts(scene.numerics)}};
}

}  // namespace repose::program
