#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/output/heap_files.hpp"
#include "engine/output/vtp_file.hpp"

namespace repose {

void write_dump(const HeapSnapshot& heap, const std::filesystem::path& file, long step) {
  Vec3 low = Vec3::Constant(-1e-3), high = Vec3::Constant(1e-3);
  for (const SphereSnapshot& sphere : heap.spheres) {
    low = low.cwiseMin(sphere.centre - Vec3::Constant(sphere.radius));
    high = high.cwiseMax(sphere.centre + Vec3::Constant(sphere.radius));
  }
  std::string text = fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n",
                                 step, heap.spheres.size());
  for (int axis = 0; axis < 3; ++axis) text += fmt::format("{:.9g} {:.9g}\n", low[axis], high[axis]);
  text += "ITEM: ATOMS id type mol x y z radius vx vy vz\n";
  auto out = std::back_inserter(text);
  for (std::size_t s = 0; s < heap.spheres.size(); ++s) {
    const SphereSnapshot& sphere = heap.spheres[s];
    const BodySnapshot& body = heap.bodies[static_cast<std::size_t>(sphere.body)];
    const Vec3 v = body.velocity + body.angular_velocity.cross(sphere.centre - body.position);
    fmt::format_to(out, "{} {} {} {:.9g} {:.9g} {:.9g} {:.9g} {:.6g} {:.6g} {:.6g}\n", s + 1, body.shape + 1,
                   sphere.body + 1, sphere.centre.x(), sphere.centre.y(), sphere.centre.z(), sphere.radius,
                   v.x(), v.y(), v.z());
  }
  write_whole(file, text);
}

}  // namespace repose
