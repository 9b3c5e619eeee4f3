#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/warning.hpp"
#include "engine/scene/heap_snapshot.hpp"
#include "engine/scene/scene.hpp"

namespace repose {

/// A top of the free surface in the plane of a flank: r from the heap's axis along the flank's direction, z
/// upwards [m]. A top beside the flank's direction stands at the r where the flank is as high as at the top's
/// place.
struct ProfilePoint {
  double r = 0.0;
  double z = 0.0;
};

/// The line z = z0 − tan(angle) r fitted to one flank.
struct Flank {
  double angle = 0.0;           ///< α_i [rad]
  double standard_error = 0.0;  ///< [rad]
  double z0 = 0.0;              ///< height of the line at r = 0 [m]
  double r_begin = 0.0;         ///< the window that the line was fitted in [m]
  double r_end = 0.0;
  std::vector<ProfilePoint> profile;  ///< tops of the surface in the flank's sector, for the picture
};

/// The heap as the article reads it (eq. 12) and the other responses.
struct HeapMeasurement {
  bool has_heap = false;
  bool unreadable = false;        ///< something lies there, but no angle can be told from it
  std::string reason;             ///< why there is no angle, with what to do; empty if there is one
  std::vector<Warning> warnings;  ///< flat_heap, few_particles, steep_flanks: of an angle that there is
  std::array<Flank, 4> flanks;    ///< along +x, −x, +y, −y
  double angle = 0.0;             ///< α_AOR = mean of the four [rad]
  double standard_error = 0.0;    ///< of α_AOR [rad]
  double peak_height = 0.0;       ///< of the free surface above the base [m]
  double mass_on_base = 0.0;      ///< [kg]
  double axis_x = 0.0;            ///< of the heap, from which the flanks' r is counted [m]
  double axis_y = 0.0;            ///< [m]
  /// The flanks' lines meet the base, in the mean of the four, less than a diameter inside its edge or
  /// beyond: the edge cuts the heap and what comes down leaves it. Otherwise the heap is a free cone.
  bool reaches_edge = false;
};

/// The 95 % interval of the angle is angle ± this × standard_error: Student's t for the 24 parts of the
/// surface that the standard error is estimated from.
inline constexpr double kAngleInterval95 = 2.07;

/// Angle of repose and responses of a heap at rest. Never throws for a heap: what cannot be read is said in
/// reason.
HeapMeasurement measure_heap(const HeapSnapshot& heap, const MeasureOptions& options = {});

/// Bulk density of the settled column in a cylinder: mass over volume of a slab between 10 % and 80 % of the
/// column's height, bodies counted by the part of their spheres' volume inside the slab [kg/m³]. 0 for an
/// empty column.
double column_bulk_density(const HeapSnapshot& column, double cylinder_radius);

}  // namespace repose
