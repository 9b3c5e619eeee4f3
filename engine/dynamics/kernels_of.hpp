#pragma once

#include "engine/dynamics/pair_kernel.hpp"
#include "engine/dynamics/wall_kernel.hpp"

namespace repose {

template <RollingModel kModel>
ForceKernels kernels_of(Arithmetic arithmetic) {
  return {arithmetic == Arithmetic::mixed ? pair_forces<kModel, Single> : pair_forces<kModel, SimdReal>,
          wall_forces<kModel>};
}

}  // namespace repose
