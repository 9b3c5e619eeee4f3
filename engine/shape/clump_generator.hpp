#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/shape/clump.hpp"
#include "engine/shape/mesh.hpp"

namespace repose {

inline constexpr int kMostSpheres = 300;  ///< that a clump may have

/// Either `spheres`, or at least one bound on an error: then the fewest spheres that meet all bounds given.
struct ClumpOptions {
  std::optional<int> spheres = {};          ///< N
  std::optional<double> volume_error = {};  ///< [-]
  std::optional<double> eit_error = {};     ///< [-]
  std::optional<double> surface_error =
      {};                   ///< mean distance of the surfaces over the equivalent diameter [-]
  double min_radius = 0.0;  ///< [m]; the smallest sphere sets the time step; never below 2 % of the diameter
  std::uint64_t seed = 1;
  int starts = 3;         ///< detections tried; the best refined clump is kept
  int max_spheres = 200;  ///< where the search for the fewest gives up
};

/// How far a clump is from the mesh that it stands for. Volume, inertia and area are those of the union of
/// spheres.
struct ClumpErrors {
  double volume_error = 0.0;       ///< |V_mesh − V_clump| / V_mesh (article eq. 11)
  double eit_error = 0.0;          ///< mean over the principal axes of |I_mesh − I_clump| / I_mesh
  double computation_error = 0.0;  ///< bound of what the integration over the union adds to either
  double centre_offset = 0.0;      ///< centre of mass of the union from that of the mesh, over the diameter
  double mean_distance = 0.0;      ///< of the clump's surface from the mesh over the equivalent diameter
  double max_distance = 0.0;       ///< the same, the worst point
  double sphericity = 0.0;         ///< of the union
};

struct GeneratedClump {
  Clump clump;  ///< mass properties of the mesh, in its principal frame; spheres that can be touched
  std::vector<Sphere> inner;  ///< spheres with no exposed surface
  ClumpErrors errors;
  bool met = true;  ///< false where max_spheres does not meet the bounds
};

/// A clump of spheres for a closed mesh (one that check_mesh() passes; lengths in m).
/// Detection: maximal balls inside the mesh (medial_balls()), chosen greedily by what they explain of the
/// surface. Refinement: fit_spheres() on the surface, exchanges of the sphere that explains least for the
/// ball that explains most, at last all centres and radii on surface, volume, centre and inertia together.
/// No centre leaves the box around the body, no radius is more than 1.5 times that of the largest ball inside
/// or of one of N equal balls of its volume, whichever is larger: so a clump of few spheres for a thin body
/// is thick, and says so in its errors. The number of exchanges is bounded, and with it the time.
/// Deterministic: the same mesh, options and seed give the same bits.
/// Throws InputError: no spheres and no bound given, a number out of range, a min_radius larger than the
/// body, so few spheres that they cannot have the mass properties of a thin body (mass_faults()).
GeneratedClump generate_clump(const Mesh& mesh, const ClumpOptions& options);

/// Errors of any clump in the frame of `body`, a mesh in its principal frame.
ClumpErrors clump_errors(const std::vector<Sphere>& spheres, const Mesh& body);

}  // namespace repose
