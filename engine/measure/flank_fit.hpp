#pragma once

#include <array>
#include <vector>

#include "engine/measure/surface.hpp"

namespace repose {

/// A top as its flank sees it. Flanks are numbered 0 … 3: +x, −x, +y, −y.
struct FlankPoint {
  int flank = 0;     ///< the flank whose quarter (±45° around its direction) the top lies in
  int side = 0;      ///< the neighbouring flank on the top's side
  double u = 0.0;    ///< distance from the axis along the flank's direction, > 0 [m]
  double v = 0.0;    ///< distance across it, 0 … u [m]
  double z = 0.0;    ///< [m]
  double phi = 0.0;  ///< azimuth around the axis, −π … π
};

/// Four straight flanks around one axis. In the quarter of flank f, with the neighbour s on the point's side,
///   z(u, v) = z0_f − √(t_f² u² + t_s² v²),   t = tan(angle):
/// on the flank's own direction the line z0_f − t_f u; beside it the level lines are ellipses, so that a heap
/// that is stretched along x or y bends no flank.
struct FlankLines {
  std::array<double, 4> z0{};     ///< [m]
  std::array<double, 4> slope{};  ///< t [-], > 0

  [[nodiscard]] double height(const FlankPoint& point) const;
  /// Distance from the axis, along the flank's direction, at which the flank is as high as at the point [m].
  [[nodiscard]] double reduced_radius(const FlankPoint& point) const;
};

/// Sees a top from the axis (x0, y0).
FlankPoint flank_point(const SurfaceTop& top, double x0, double y0);

/// Least squares with Tukey's biweight: tops farther than reach from their line have no weight.
/// @param points at least one; where a flank has none, its line stays as it is
FlankLines fit_robust(const std::vector<FlankPoint>& points, FlankLines start, double reach, int iterations);

/// Maximum likelihood with the density of the distances estimated on the way (Stone 1975; Bickel 1982): all
/// four flanks share one density f, and
///   Σ_i w_i log f(z_i − z(u_i, v_i)) → max
/// by scoring steps. Where tops end sharply at the surface, the edge of f fixes the slope; where they scatter
/// about it, the fit becomes that of least squares. The offset of the tops from the surface drops out, being
/// common to all; that of the lines from the tops is chosen so that the mean distance is zero.
/// @param weights   of the points, 0 … 1
/// @param bandwidth of the density's kernel [m]
FlankLines fit_adaptive(const std::vector<FlankPoint>& points, const std::vector<double>& weights,
                        FlankLines start, double bandwidth, int iterations);

}  // namespace repose
