#include "engine/stability/method.hpp"

#include "engine/scene/names.hpp"

namespace repose {

namespace {

bool has_torque_limit(RollingModel model) {
  return model == RollingModel::type_a || model == RollingModel::type_a_relative;
}

}  // namespace

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const auto& integrator : kNames<Integrator>)
    for (const auto& rolling : kNames<RollingModel>) {
      methods.push_back({integrator.value, rolling.value, RollingTorque::limited});
      if (rolling.value == RollingModel::type_a)
        methods.push_back({integrator.value, rolling.value, RollingTorque::unlimited});
    }
  return methods;
}

Method method_of(const Scene& scene) {
  const RollingModel model = scene.contact.rolling_model;
  return {scene.numerics.integrator, model,
          has_torque_limit(model) ? scene.contact.rolling_torque : RollingTorque::limited};
}

std::string rolling_name(const Method& method) {
  std::string name(choice_name(method.rolling_model));
  if (method.rolling_torque == RollingTorque::unlimited) name += " unlimited";
  return name;
}

Scene with_method(Scene scene, const Method& method) {
  scene.numerics.integrator = method.integrator;
  scene.contact.rolling_model = method.rolling_model;
  scene.contact.rolling_torque = method.rolling_torque;
  return scene;
}

}  // namespace repose
