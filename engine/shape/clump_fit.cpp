#include "engine/shape/clump_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace repose {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Errors of volume, centre and inertia, as the objective counts them, from the ten moments.
Moments mass_errors(const Moments& m, const FitTarget& target) {
  const Vec3& I = target.moments;
  Moments errors;
  errors << m[0] / target.volume - 1.0, m[1] / target.volume, m[2] / target.volume, m[3] / target.volume,
      (m[5] + m[6]) / I[0] - 1.0, (m[4] + m[6]) / I[1] - 1.0, (m[4] + m[5]) / I[2] - 1.0,
      m[7] / std::sqrt(I[0] * I[1]), m[8] / std::sqrt(I[0] * I[2]), m[9] / std::sqrt(I[1] * I[2]);
  return errors;
}

/// mass_errors() without its constants is linear: applied to every column of the gradient.
MatrixXd mass_error_gradient(const MatrixXd& gradient, const FitTarget& target) {
  const Moments zero = mass_errors(Moments::Zero(), target);
  MatrixXd result(kMoments, gradient.cols());
  for (Index i = 0; i < gradient.cols(); ++i) result.col(i) = mass_errors(gradient.col(i), target) - zero;
  return result;
}

double objective(const std::vector<Sphere>& spheres, const FitTarget& target, const FitOptions& options) {
  double sum = 0.0;
  for (const double gap : surface_gaps(spheres, target.points).gap) sum += gap * gap;
  sum /= static_cast<double>(target.points.size());
  if (options.mass_weight > 0.0)
    sum += std::pow(options.mass_weight, 2) *
           mass_errors(unite(spheres, options.panels).moments, target).squaredNorm();
  return sum;
}

/// Half of gradient and of Gauss–Newton's Hessian of the objective.
struct NormalEquations {
  MatrixXd matrix;
  VectorXd rhs;  ///< −gradient
};

NormalEquations normal_equations(const std::vector<Sphere>& spheres, const FitTarget& target,
                                 const FitOptions& options) {
  const Index unknowns = 4 * static_cast<Index>(spheres.size());
  NormalEquations normal{MatrixXd::Zero(unknowns, unknowns), VectorXd::Zero(unknowns)};
  const SurfaceGaps gaps = surface_gaps(spheres, target.points);
  const double weight = 1.0 / static_cast<double>(target.points.size());
  for (std::size_t s = 0; s < target.points.size(); ++s) {
    const Sphere& sphere = spheres[gaps.owner[s]];
    const Vec3 from = sphere.centre - target.points[s];
    const double distance = from.norm();
    if (distance == 0.0) continue;
    Eigen::Vector4d row;
    row << from / distance, -1.0;
    const Index at = 4 * static_cast<Index>(gaps.owner[s]);
    normal.matrix.block<4, 4>(at, at) += weight * row * row.transpose();
    normal.rhs.segment<4>(at) -= weight * gaps.gap[s] * row;
  }
  if (options.mass_weight > 0.0) {
    const UnionOfSpheres sum = unite(spheres, options.panels, true);
    const MatrixXd rows = options.mass_weight * mass_error_gradient(sum.gradient, target);
    normal.matrix.noalias() += rows.transpose() * rows;
    normal.rhs.noalias() -= options.mass_weight * rows.transpose() * mass_errors(sum.moments, target);
  }
  return normal;
}

/// Solves (matrix + damping · scale) step = rhs. Without mass properties no two spheres share a residual: the
/// matrix is made of blocks of four.
VectorXd damped_step(const NormalEquations& normal, const VectorXd& scale, double damping, bool coupled) {
  MatrixXd damped = normal.matrix;
  damped.diagonal() += damping * scale;
  if (coupled) return damped.ldlt().solve(normal.rhs);
  VectorXd step(normal.rhs.size());
  for (Index at = 0; at < step.size(); at += 4) {
    const Eigen::Matrix4d block = damped.block<4, 4>(at, at);
    step.segment<4>(at) = block.ldlt().solve(normal.rhs.segment<4>(at));
  }
  return step;
}

/// What the radii and centres of a fit keep to.
struct Bounds {
  double least = 0.0;    ///< radius
  double largest = 0.0;  ///< radius
  Eigen::AlignedBox3d room;

  explicit Bounds(const FitTarget& target)
      : least(std::max(target.min_radius, kLeastRadius)),
        largest(std::max(target.max_radius, least)),
        room(target.room) {}

  [[nodiscard]] Sphere applied(Sphere sphere) const {
    sphere.radius = std::clamp(sphere.radius, least, largest);
    if (!room.isEmpty()) sphere.centre = sphere.centre.cwiseMax(room.min()).cwiseMin(room.max());
    return sphere;
  }
  /// Whether number k of (x, y, z, r) stands at a bound that a step along `rhs` would cross.
  [[nodiscard]] bool holds(const Sphere& sphere, Index k, double rhs) const {
    if (k == 3) return rhs < 0.0 ? sphere.radius <= least : rhs > 0.0 && sphere.radius >= largest;
    if (room.isEmpty()) return false;
    return rhs < 0.0 ? sphere.centre[k] <= room.min()[k] : rhs > 0.0 && sphere.centre[k] >= room.max()[k];
  }
};

/// Numbers that stand at their bound and would go beyond it take no part in the step.
void hold_at_bound(NormalEquations& normal, const std::vector<Sphere>& spheres, const Bounds& bounds) {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    for (Index own = 0; own < 4; ++own) {
      const Index i = 4 * static_cast<Index>(k) + own;
      if (!bounds.holds(spheres[k], own, normal.rhs[i])) continue;
      normal.matrix.row(i).setZero();
      normal.matrix.col(i).setZero();
      normal.matrix(i, i) = 1.0;
      normal.rhs[i] = 0.0;
    }
  }
}

std::vector<Sphere> stepped(const std::vector<Sphere>& spheres, const VectorXd& step, const Bounds& bounds) {
  // A sphere that owns few points is held by little: no step of one iteration may carry it away.
  constexpr double kLongestStep = 0.1;
  std::vector<Sphere> moved = spheres;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    const Index at = 4 * static_cast<Index>(k);
    const double length = step.segment<4>(at).norm();
    const double share = length > kLongestStep ? kLongestStep / length : 1.0;
    moved[k].centre += share * step.segment<3>(at);
    moved[k].radius += share * step[at + 3];
    moved[k] = bounds.applied(moved[k]);
  }
  return moved;
}

}  // namespace

SurfaceGaps surface_gaps(const std::vector<Sphere>& spheres, const std::vector<Vec3>& points) {
  SurfaceGaps gaps;
  gaps.gap.assign(points.size(), std::numeric_limits<double>::infinity());
  gaps.owner.assign(points.size(), 0);
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const Sphere& sphere = spheres[k];
    for (std::size_t s = 0; s < points.size(); ++s) {
      const double gap = (points[s] - sphere.centre).norm() - sphere.radius;
      if (gap < gaps.gap[s]) {
        gaps.gap[s] = gap;
        gaps.owner[s] = k;
      }
    }
  }
  return gaps;
}

double fit_spheres(std::vector<Sphere>& spheres, const FitTarget& target, const FitOptions& options) {
  constexpr double kLargestDamping = 1e8;
  const Bounds bounds(target);
  for (Sphere& sphere : spheres) sphere = bounds.applied(sphere);
  double value = objective(spheres, target, options);
  double damping = 1e-3;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    NormalEquations normal = normal_equations(spheres, target, options);
    hold_at_bound(normal, spheres, bounds);
    // The damping is relative to the samples that a sphere owns, with a floor for a sphere that owns none; a
    // little of it always acts, for what the samples leave free.
    const double floor = 1e-3 / static_cast<double>(spheres.size());
    const VectorXd scale = normal.matrix.diagonal().array() + floor;
    normal.matrix.diagonal().array() += 1e-3 * floor;
    const double before = value;
    while (damping < kLargestDamping) {
      const VectorXd step = damped_step(normal, scale, damping, options.mass_weight > 0.0);
      std::vector<Sphere> next = stepped(spheres, step, bounds);
      const double next_value = objective(next, target, options);
      if (next_value < value) {
        spheres = std::move(next);
        value = next_value;
        damping = std::max(damping * 0.2, 1e-9);
        break;
      }
      damping *= 5.0;
    }
    if (damping >= kLargestDamping || before - value < options.tolerance * before) break;
  }
  return value;
}

}  // namespace repose
