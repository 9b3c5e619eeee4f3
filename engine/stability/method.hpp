#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace repose {

/// What decides how large a step may be, beside the scene: how forces become motion, and which rolling model
/// turns the bodies.
struct Method {
  Integrator integrator = Integrator::symplectic_euler;
  RollingModel rolling_model = RollingModel::type_a;
  RollingTorque rolling_torque = RollingTorque::limited;

  bool operator==(const Method&) const = default;
};

/// Every integrator with every rolling model; type_a also without the limit of its torque, where its sign
/// flips at every step of a heap at rest.
std::vector<Method> all_methods();

/// The method of a scene; the torque's limit counts for type_a and type_a_relative only.
Method method_of(const Scene& scene);

/// "type_a", "type_a unlimited", …
std::string rolling_name(const Method& method);

/// The scene with another method.
Scene with_method(Scene scene, const Method& method);

}  // namespace repose
