#pragma once

#include "support/test_scene.hpp"

namespace repose::verification {

/// A body of three moments that spins nearly about its middle axis.
inline Bodies tumbling_body() {
  Clump clump;
  clump.name = "body";
  clump.spheres = {{Vec3(1e-3, 0.0, 0.0), 2e-3}};
  clump.volume = 1e-7;
  clump.inertia = {1e-12, 2e-12, 2.8e-12};
  Bodies bodies(std::vector{clump}, 1000.0);
  NewBody body;
  body.angular_velocity = {0.01, 20.0, 0.01};
  bodies.add(body);
  return bodies;
}

}  // namespace repose::verification
