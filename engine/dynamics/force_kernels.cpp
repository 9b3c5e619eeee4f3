#include "engine/dynamics/force_kernels.hpp"

#include "engine/contact/simd.hpp"

namespace repose {

void TouchingList::start(std::size_t most) {
  count = 0;
  if (history.size() >= most + NearList::kBlock) return;
  for (auto* array : {&history, &placed_a, &placed_b, &body_a, &body_b})
    array->resize(most + most / 2 + NearList::kBlock);
}

void TouchingList::finish() {
  for (std::size_t k = count; k % kSimdWidth != 0; ++k)
    for (auto* array : {&history, &placed_a, &placed_b, &body_a, &body_b}) (*array)[k] = (*array)[count - 1];
}

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
