#include "engine/dynamics/force_kernels.hpp"

namespace repose {

template <>
ForceKernels make_force_kernels<RollingModel::type_a>();
template <>
ForceKernels make_force_kernels<RollingModel::type_a_relative>();
template <>
ForceKernels make_force_kernels<RollingModel::type_c>();
template <>
ForceKernels make_force_kernels<RollingModel::type_c_undamped>();

ForceKernels force_kernels(RollingModel model) {
  switch (model) {
    case RollingModel::type_a:
      return make_force_kernels<RollingModel::type_a>();
    case RollingModel::type_a_relative:
      return make_force_kernels<RollingModel::type_a_relative>();
    case RollingModel::type_c:
      return make_force_kernels<RollingModel::type_c>();
    case RollingModel::type_c_undamped:
      return make_force_kernels<RollingModel::type_c_undamped>();
  }
  return {};
}

}  // namespace repose
