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

}  // namespace repose::test
