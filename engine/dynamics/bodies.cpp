#include "engine/dynamics/bodies.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

BodyAxes body_axes(const Vec3& position, const Mat3& turn, double scale) {
  BodyAxes axes;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) axes.column[column][row] = scale * turn(row, column);
  for (int k = 0; k < 3; ++k) axes.position[k] = position[k];
  axes.position[3] = scale;
  return axes;
}

Bodies::Bodies(std::span<const Clump> clumps, double density_of_all)
    : shapes(clumps.begin(), clumps.end()), density(density_of_all) {
  oriented = std::any_of(shapes.begin(), shapes.end(), [](const Clump& clump) {
    return clump.spheres.size() != 1 || clump.spheres.front().centre.norm() > 0.0;
  });
}

template <class Visit>
void Bodies::for_each_array(Visit visit) {
  for (auto* array : {&x, &y, &z, &lx, &ly, &lz, &qw, &qx, &qy, &qz, &inverse_i1, &inverse_i2, &inverse_i3,
                      &reach, &swing, &travel, &swung, &pace, &scale})
    visit(*array);
  visit(motion);
  visit(load);
  visit(lead);
  visit(axes);
  visit(shape);
  visit(id);
}

void Bodies::resize(std::size_t entries) {
  for_each_array([entries](auto& array) { array.resize(entries); });
}

std::size_t Bodies::add(const NewBody& body) {
  const std::size_t i = count++;
  if (x.size() < padded()) {
    resize(padded());
    for (std::size_t k = i; k < x.size(); ++k) qw[k] = 1.0;  // padding stays a resting body without inertia
  }
  const Clump& clump = shapes[static_cast<std::size_t>(body.shape)];
  const double s = body.scale;
  const Vec3 moments = clump.inertia * (density * s * s * s * s * s);
  const Quat q = body.orientation.normalized();

  x[i] = body.position.x(), y[i] = body.position.y(), z[i] = body.position.z();
  qw[i] = q.w(), qx[i] = q.x(), qy[i] = q.y(), qz[i] = q.z();
  inverse_i1[i] = 1.0 / moments.x(), inverse_i2[i] = 1.0 / moments.y(), inverse_i3[i] = 1.0 / moments.z();
  const Mat3 axes_of_body = q.toRotationMatrix();
  const Vec3 momentum =
      axes_of_body * moments.asDiagonal() * axes_of_body.transpose() * body.angular_velocity;
  lx[i] = momentum.x(), ly[i] = momentum.y(), lz[i] = momentum.z();
  axes[i] = body_axes(body.position, axes_of_body, s);

  motion[i] = {};
  for (int k = 0; k < 3; ++k) {
    motion[i].velocity[k] = body.velocity[k];
    motion[i].w[k] = body.angular_velocity[k];
  }
  motion[i].mass = density * s * s * s * clump.volume;
  motion[i].inertia_term = moments.mean();
  load[i] = {};
  lead[i] = {};
  reach[i] = s * clump.bounding_radius();
  swing[i] = 0.0;
  for (const Sphere& sphere : clump.spheres) swing[i] = std::max(swing[i], s * sphere.centre.norm());
  travel[i] = swung[i] = pace[i] = 0.0;
  scale[i] = s;
  shape[i] = body.shape;
  id[i] = i == 0 ? 0 : 1 + *std::max_element(id.begin(), id.begin() + static_cast<std::ptrdiff_t>(i));
  return i;
}

std::vector<int> Bodies::retain(std::span<const char> keep) {
  std::vector<int> new_index(count, -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!keep[i]) continue;
    new_index[i] = static_cast<int>(kept);
    for_each_array([kept, i](auto& array) { array[kept] = array[i]; });
    ++kept;
  }
  count = kept;
  // What remains behind the last body becomes padding: at rest and without inertia.
  resize(count);
  resize(padded());
  for (std::size_t i = count; i < padded(); ++i) qw[i] = 1.0;
  return new_index;
}

double Bodies::kinetic_energy(std::size_t i) const {
  const Vec3 momentum(lx[i], ly[i], lz[i]);
  return 0.5 * (motion[i].mass * velocity(i).squaredNorm() + momentum.dot(angular_velocity(i)));
}

}  // namespace repose
