#pragma once

#include <array>
#include <vector>

#include "engine/measure/flank_fit.hpp"
#include "engine/scene/scene.hpp"

namespace repose {

/// What is known of a heap before its flanks are read.
struct HeapOutline {
  std::size_t bodies = 0;
  double x0 = 0.0;           ///< a first guess of the axis [m]
  double y0 = 0.0;           ///< [m]
  double height = 0.0;       ///< of the highest top [m]
  double radius = 0.0;       ///< that holds 95 % of the tops, around the first axis [m]
  double diameter = 0.0;     ///< d, the median of the tops' bodies [m]
  double edge_radius = 0.0;  ///< beyond which no top counts, from the base's centre [m]; may be infinite
};

/// The part of the surface that the lines are fitted in.
struct FlankWindow {
  double lowest = 0.0;  ///< height of the lines, which the single layer around the foot stays below [m]
  bool in_radius =
      false;         ///< flat heap: low and high limit the distance from the axis, not the lines' height
  double low = 0.0;  ///< height, or radius [m]
  double high = 0.0;
};

/// Four flanks and the tops that they were read from.
struct FlankReading {
  FlankLines lines;
  double x0 = 0.0;  ///< the axis: midway between opposite flanks at the window's middle height [m]
  double y0 = 0.0;
  double bandwidth = 0.0;  ///< of the density of the distances [m]
  FlankWindow window;
  std::vector<FlankPoint> points;  ///< inside the window
  bool readable = false;           ///< every flank has tops enough, kLeastTops
};

inline constexpr int kLeastTops = 4;

/// Height in diameters below which a heap is flat.
inline constexpr double kFlatHeight = 4.0;

/// Finds the axis, the window and the lines together: a robust fit first, then the fit by the tops' own
/// distribution. A line's height, not a top's own, decides what lies in the window, for a limit on scattered
/// heights would tilt the line.
FlankReading read_flanks(const std::vector<SurfaceTop>& surface, const HeapOutline& outline,
                         const MeasureOptions& options);

/// Standard errors of the flanks' angles and of their mean.
struct AngleErrors {
  std::array<double, 4> flank{};  ///< [rad]
  double mean = 0.0;              ///< [rad]
};

/// Jackknife over 24 wedges around the axis: the fit is repeated without each of them, and
///   σ² = (n − 1)/n Σ (α₍₋b₎ − ᾱ)².
/// Tops of one wedge may depend on one another at any distance along the slope; a top's neighbours in the
/// next wedge are few.
AngleErrors angle_errors(const FlankReading& reading);

}  // namespace repose
