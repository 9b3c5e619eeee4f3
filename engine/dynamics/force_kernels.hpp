#pragma once

#include <span>
#include <vector>

#include "engine/contact/contact_law.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"

namespace repose {

/// Everything that the force kernels of one step read and write.
struct ForceStep {
  LawParameters pair_law;
  LawParameters wall_law;
  double dt = 0.0;
  bool leads = false;  ///< damping is given velocities with Bodies::lead added (velocity_verlet)
  double lag = 0.0;    ///< ContactTiming::lag
  bool booked = true;  ///< whether the kernels return their work; zero otherwise
};

/// Work of all contacts of one step, see ContactPower; `wall` is what moving walls did on the bodies [J].
struct ContactWork {
  double normal_damping = 0.0, tangential_damping = 0.0, spring = 0.0, rolling = 0.0, wall = 0.0;
};

/// Scratch of the kernels, kept from step to step so that a step allocates nothing.
struct TouchingWalls {
  std::vector<std::int32_t> candidate;
  std::vector<double> nx, ny, nz, overlap;  ///< geometry at the wall
};

/// The kernels of one rolling model. Each returns the work of its contacts, adds forces and torques to
/// Bodies::load and brings the history of its contacts to this step; contacts are taken in the order of the
/// candidates, so sums do not depend on how they are grouped.
struct ForceKernels {
  ContactWork (*pairs)(const ForceStep&, Bodies&, ContactList&,
                       std::vector<std::int32_t>& touching) = nullptr;
  ContactWork (*walls)(const ForceStep&, Bodies&, ContactList&, std::span<const Wall>,
                       TouchingWalls& touching) = nullptr;
};

/// The kernels for a rolling model, chosen once per run.
ForceKernels force_kernels(RollingModel model);

template <RollingModel kModel>
ForceKernels make_force_kernels();

}  // namespace repose
