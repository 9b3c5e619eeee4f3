#include "engine/dynamics/kernels_of.hpp"

// One file per rolling model, so that the kernels compile side by side.
namespace repose {

template <>
ForceKernels make_force_kernels<RollingModel::type_a_relative>(Arithmetic arithmetic) {
  return kernels_of<RollingModel::type_a_relative>(arithmetic);
}

}  // namespace repose
