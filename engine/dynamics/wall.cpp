#include "engine/dynamics/wall.hpp"

#include <algorithm>
#include <cmath>

namespace repose {

namespace {

/// √(x² + y²): lengths here are far from the ends of the range that std::hypot guards at four times the
/// price.
double planar(double x, double y) { return std::sqrt(x * x + y * y); }

/// From the nearest point of the wall to `point`; a point exactly on the wall has no direction, and keeps +z.
WallDistance from_nearest(const Vec3& nearest, const Vec3& point) {
  const Vec3 away = point - nearest;
  const double distance = away.norm();
  return distance > 0.0 ? WallDistance{away / distance, distance} : WallDistance{Vec3::UnitZ(), 0.0};
}

/// Solid upright cylinder: above it the top, beyond its edge the rim, below that the side.
WallDistance distance_to_base(const Wall& wall, const Vec3& p) {
  if (std::isinf(wall.radius)) return {Vec3::UnitZ(), p.z()};
  const double rho = planar(p.x(), p.y());
  if (rho <= wall.radius) {
    const double below = -p.z();
    const double inside = wall.radius - rho;
    if (below <= inside || rho == 0.0) return {Vec3::UnitZ(), p.z()};
    return {Vec3(p.x() / rho, p.y() / rho, 0.0), -inside};
  }
  const Vec3 radial(p.x() / rho, p.y() / rho, 0.0);
  Vec3 nearest = wall.radius * radial;
  nearest.z() = std::clamp(p.z(), wall.z_low, 0.0);
  return from_nearest(nearest, p);
}

WallDistance distance_to_closed_shell(const Wall& wall, const Vec3& p) {
  const double rho = planar(p.x() - wall.x_offset, p.y());
  if (rho == 0.0 || p.z() > wall.z_high) return {};
  return {Vec3(-(p.x() - wall.x_offset) / rho, -p.y() / rho, 0.0), wall.radius - rho};
}

/// Thin shell: the nearest point has the point's own direction from the axis and its own height, each clamped
/// to the part of the cylinder that is there. For a half, directions beyond its two vertical edges fall on
/// the nearer edge.
WallDistance distance_to_shell(const Wall& wall, const Vec3& p) {
  double dx = p.x() - wall.x_offset;
  double dy = p.y();
  const bool beyond = (wall.kind == Wall::Kind::half_shell_plus && dx < 0.0) ||
                      (wall.kind == Wall::Kind::half_shell_minus && dx > 0.0);
  if (beyond) {
    dx = 0.0;
    dy = dy < 0.0 ? -1.0 : 1.0;
  }
  const double rho = planar(dx, dy);
  if (rho == 0.0) return {};  // on the axis: a radius away, in every direction
  const Vec3 nearest(wall.x_offset + wall.radius * dx / rho, wall.radius * dy / rho,
                     std::clamp(p.z(), wall.z_low, wall.z_high));
  return from_nearest(nearest, p);
}

}  // namespace

WallDistance distance_to(const Wall& wall, const Vec3& point) {
  switch (wall.kind) {
    case Wall::Kind::base:
      return distance_to_base(wall, point);
    case Wall::Kind::closed_shell:
      return distance_to_closed_shell(wall, point);
    case Wall::Kind::open_shell:
    case Wall::Kind::half_shell_plus:
    case Wall::Kind::half_shell_minus:
      return distance_to_shell(wall, point);
  }
  return {};
}

bool within_reach(const Wall& wall, const Vec3& p, double reach) {
  const double dx = p.x() - wall.x_offset, rho_squared = dx * dx + p.y() * p.y();
  if (wall.kind == Wall::Kind::closed_shell) {
    const double from_axis = wall.radius - reach;
    return from_axis <= 0.0 || rho_squared > from_axis * from_axis;
  }
  if (wall.kind == Wall::Kind::base && p.z() >= 0.0 && rho_squared <= wall.radius * wall.radius)
    return p.z() < reach;
  return distance_to(wall, p).distance < reach;
}

}  // namespace repose
