#include "engine/dynamics/pair_kernel.hpp"
#include "engine/dynamics/wall_kernel.hpp"

// One file per rolling model, so that the kernels compile side by side.
namespace repose {

template <>
ForceKernels make_force_kernels<RollingModel::type_c_undamped>() {
  return {pair_forces<RollingModel::type_c_undamped>, wall_forces<RollingModel::type_c_undamped>};
}

}  // namespace repose
