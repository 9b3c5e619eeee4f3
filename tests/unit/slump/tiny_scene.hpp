#pragma once

#include "engine/slump/slump_test.hpp"
#include "support/test_scene.hpp"

namespace repose::test {

/// A slump test small enough for a fraction of a second: some hundred spheres of 10 mm in a cylinder of 60
/// mm.
inline Scene tiny_scene(RollingModel rolling = RollingModel::type_c) {
  Scene scene = scene_of({sphere_clump(5e-3)}, {2500.0, 1e8, 0.25}, {0.4, 0.5, 0.1}, rolling);
  scene.particles.total_mass = 0.12;
  scene.test.base_radius = 0.06;
  scene.test.base_height = 0.02;
  scene.test.cylinder_radius = 0.03;
  scene.test.cylinder_height = 0.12;
  scene.test.pour_rate = 1.0;
  scene.numerics.stiffness_scale = 0.01;
  scene.numerics.time_step_fraction = 0.2;
  return scene;
}

/// About 300 spheres of 4 mm, stiff enough and with a step small enough that nothing is to be said but that
/// they are few: a heap of 3 to 4 diameters.
inline Scene sound_scene() {
  Scene scene = scene_of({sphere_clump(2e-3)}, {2500.0, 2e6, 0.25}, {0.3, 0.5, 0.1}, RollingModel::type_a);
  scene.particles.total_mass = 0.025;
  scene.test = {.base_radius = 0.03,
                .base_height = 0.02,
                .cylinder_radius = 0.015,
                .cylinder_height = 0.12,
                .pour_rate = 0.5,
                .opening_speed = 1.0,
                .shared_columns = {}};
  scene.numerics.time_step_fraction = 0.2;
  return scene;
}

}  // namespace repose::test
