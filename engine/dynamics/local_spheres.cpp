#include "engine/dynamics/local_spheres.hpp"

#include "engine/contact/simd.hpp"

namespace repose {

namespace {

constexpr double kOutOfReach = 1e9;  ///< [m]

}  // namespace

LocalSpheres::LocalSpheres(std::span<const Clump> shapes) {
  const auto push = [this](const Vec3& centre, double r) {
    x.push_back(centre.x()), y.push_back(centre.y()), z.push_back(centre.z()), radius.push_back(r);
  };
  for (const Clump& shape : shapes) {
    first_row.push_back(static_cast<std::int32_t>(rows.size()));
    first_column.push_back(x.size());
    for (const Sphere& sphere : shape.spheres) {
      const Vec3& c = sphere.centre;
      rows.push_back({{c.x(), c.y(), c.z()}, sphere.radius, {1.0, 1.0, 1.0, sphere.radius}});
      push(c, sphere.radius);
    }
    while (x.size() % kSimdWidth != 0) push({kOutOfReach, kOutOfReach, kOutOfReach}, 0.0);
  }
  first_row.push_back(static_cast<std::int32_t>(rows.size()));
  first_column.push_back(x.size());
}

}  // namespace repose
