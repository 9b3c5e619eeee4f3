#include "engine/dynamics/pair_kernel.hpp"
#include "engine/dynamics/wall_kernel.hpp"

// One file per rolling model, so that the kernels compile side by side.
namespace repose {

template <>
ForceKernels make_force_kernels<RollingModel::type_c>() {
  return {pair_forces<RollingModel::type_c>, wall_forces<RollingModel::type_c>};
}

}  // namespace repose
