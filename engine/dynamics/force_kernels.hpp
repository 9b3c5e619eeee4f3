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
};

/// Scratch of the kernels, kept from step to step so that a step allocates nothing.
struct TouchingWalls {
  std::vector<std::int32_t> candidate;
  std::vector<double> nx, ny, nz, overlap;  ///< geometry at the wall
};

/// The kernels of one rolling model. Each adds forces and torques to Bodies::load and brings the history of
/// its contacts to this step; contacts are taken in the order of the candidates, so sums do not depend on how
/// they are grouped.
struct ForceKernels {
  void (*pairs)(const ForceStep&, Bodies&, ContactList&, std::vector<std::int32_t>& touching) = nullptr;
  void (*walls)(const ForceStep&, Bodies&, ContactList&, std::span<const Wall>,
                TouchingWalls& touching) = nullptr;
};

/// The kernels for a rolling model, chosen once per run.
ForceKernels force_kernels(RollingModel model);

template <RollingModel kModel>
ForceKernels make_force_kernels();

}  // namespace repose
