#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/scene/scene.hpp"

namespace repose {

template <class Choice>
struct Named {
  Choice value;
  std::string_view name;
};

/// The words of a case for each choice of the engine.
template <class Choice>
inline constexpr std::array<Named<Choice>, 0> kNames{};

template <>
inline constexpr std::array<Named<RollingModel>, 4> kNames<RollingModel>{
    {{RollingModel::type_a, "type_a"},
     {RollingModel::type_a_relative, "type_a_relative"},
     {RollingModel::type_c, "type_c"},
     {RollingModel::type_c_undamped, "type_c_undamped"}}};

template <>
inline constexpr std::array<Named<TangentialHistory>, 2> kNames<TangentialHistory>{
    {{TangentialHistory::force, "force"}, {TangentialHistory::displacement, "displacement"}}};

template <>
inline constexpr std::array<Named<NormalDamping>, 2> kNames<NormalDamping>{
    {{NormalDamping::with_tail, "with_tail"}, {NormalDamping::clamped, "clamped"}}};

template <>
inline constexpr std::array<Named<RollingTorque>, 2> kNames<RollingTorque>{
    {{RollingTorque::limited, "limited"}, {RollingTorque::unlimited, "unlimited"}}};

template <>
inline constexpr std::array<Named<Integrator>, 3> kNames<Integrator>{
    {{Integrator::symplectic_euler, "symplectic_euler"},
     {Integrator::velocity_verlet, "velocity_verlet"},
     {Integrator::explicit_euler, "explicit_euler"}}};

template <>
inline constexpr std::array<Named<Arithmetic>, 2> kNames<Arithmetic>{
    {{Arithmetic::double_precision, "double"}, {Arithmetic::mixed, "mixed"}}};

template <>
inline constexpr std::array<Named<TestKind>, 2> kNames<TestKind>{
    {{TestKind::split_cylinder, "split_cylinder"}, {TestKind::lifted_cylinder, "lifted_cylinder"}}};

template <>
inline constexpr std::array<Named<Filling>, 3> kNames<Filling>{
    {{Filling::pour, "pour"}, {Filling::rain, "rain"}, {Filling::packing, "packing"}}};

template <>
inline constexpr std::array<Named<Opening>, 2> kNames<Opening>{
    {{Opening::moved, "moved"}, {Opening::instant, "instant"}}};

/// "type_a" for RollingModel::type_a, and so on.
template <class Choice>
constexpr std::string_view choice_name(Choice choice) {
  const auto found = std::ranges::find(kNames<Choice>, choice, &Named<Choice>::value);
  return found == kNames<Choice>.end() ? std::string_view() : found->name;
}

/// RollingModel::type_a for "type_a", nothing for a word that names no choice.
template <class Choice>
constexpr std::optional<Choice> choice_of(std::string_view name) {
  const auto found = std::ranges::find(kNames<Choice>, name, &Named<Choice>::name);
  if (found == kNames<Choice>.end()) return std::nullopt;
  return found->value;
}

template <class Choice>
std::vector<std::string_view> choice_names() {
  std::vector<std::string_view> names;
  names.reserve(kNames<Choice>.size());
  for (const Named<Choice>& choice : kNames<Choice>) names.push_back(choice.name);
  return names;
}

}  // namespace repose
