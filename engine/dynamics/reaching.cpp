#include "engine/dynamics/reaching.hpp"

#include <bit>

#include "engine/contact/simd.hpp"

namespace repose {

namespace {

constexpr double kPadding = 1e6;  ///< where the padding lies [m]

}  // namespace

void Reaching::make_room(std::size_t spheres) {
  const std::size_t room = spheres + 2 * kSimdWidth;
  if (x.size() >= room) return;
  sphere.resize(room);
  for (auto* array : {&x, &y, &z, &radius}) array->resize(room);
}

/// The point is brought into the frame of the spheres, at scale 1, so that only those that are found are
/// turned: with M = scale × R, R the turn of the body, it lies Mᵀ d/scale² from the centre of mass there.
void Reaching::find(const LocalSpheres& local, const Of& body, const Vec3& point, double reach,
                    const Vec3& origin) {
  const auto shape = static_cast<std::size_t>(body.shape);
  const std::size_t begin = local.first_column[shape], end = local.first_column[shape + 1];
  make_room(end - begin);
  const double scale = body.axes.position[3];
  const Vec3 d = (point - body.position) / (scale * scale);
  const auto along = [&](int k) { return SimdReal(Vec3(body.axes.column[k]).dot(d)); };
  const SimdReal cx = along(0), cy = along(1), cz = along(2), local_reach = reach / scale;
  count = 0;
  for (std::size_t first = begin; first < end; first += kSimdWidth) {
    const SimdReal dx = load(local.x, first) - cx, dy = load(local.y, first) - cy,
                   dz = load(local.z, first) - cz, far = load(local.radius, first) + local_reach;
    for (unsigned near = less_bits(dx * dx + dy * dy + dz * dz, far * far); near != 0; near &= near - 1) {
      const std::size_t k = first + static_cast<std::size_t>(std::countr_zero(near));
      sphere[count] = static_cast<std::int32_t>(body.first_sphere + (k - begin));
      x[count] = local.x[k], y[count] = local.y[k], z[count] = local.z[k], radius[count] = local.radius[k];
      ++count;
    }
  }
  place(body.axes, body.position - origin);
}

void Reaching::place(const BodyAxes& axes, const Vec3& shift) {
  const auto turned = [&](std::size_t row, const SimdReal& a, const SimdReal& b, const SimdReal& c) {
    return axes.column[0][row] * a + axes.column[1][row] * b + axes.column[2][row] * c +
           shift[static_cast<Eigen::Index>(row)];
  };
  for (std::size_t first = 0; first < count; first += kSimdWidth) {
    const SimdReal a = load(x, first), b = load(y, first), c = load(z, first);
    store(turned(0, a, b, c), x, first);
    store(turned(1, a, b, c), y, first);
    store(turned(2, a, b, c), z, first);
    store(axes.position[3] * load(radius, first), radius, first);
  }
  for (std::size_t k = count; k % kSimdWidth != 0; ++k) {
    x[k] = y[k] = z[k] = kPadding;
    radius[k] = 0.0;
  }
}

}  // namespace repose
