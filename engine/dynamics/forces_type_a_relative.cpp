#include "engine/dynamics/pair_kernel.hpp"
#include "engine/dynamics/wall_kernel.hpp"

// One file per rolling model, so that the kernels compile side by side.
namespace repose {

template <>
ForceKernels make_force_kernels<RollingModel::type_a_relative>() {
  return {pair_forces<RollingModel::type_a_relative>, wall_forces<RollingModel::type_a_relative>};
}

}  // namespace repose
