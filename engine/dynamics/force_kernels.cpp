#include "engine/dynamics/force_kernels.hpp"

#include "engine/contact/simd.hpp"

namespace repose {

void TouchingList::start(std::size_t most) {
  count = 0;
  if (history.size() >= most + 2 * NearList::kBlock) return;
  for (auto* array : {&history, &placed_a, &placed_b, &body_a, &body_b})
    array->resize(most + most / 2 + 2 * NearList::kBlock);
}

void TouchingList::finish() {
  for (std::size_t k = count; k % (2 * kSimdWidth) != 0; ++k)
    for (auto* array : {&history, &placed_a, &placed_b, &body_a, &body_b}) (*array)[k] = (*array)[count - 1];
}

template <>
ForceKernels make_force_kernels<RollingModel::type_a>(Arithmetic);
template <>
ForceKernels make_force_kernels<RollingModel::type_a_relative>(Arithmetic);
template <>
ForceKernels make_force_kernels<RollingModel::type_c>(Arithmetic);
template <>
ForceKernels make_force_kernels<RollingModel::type_c_undamped>(Arithmetic);

ForceKernels force_kernels(RollingModel model, Arithmetic arithmetic) {
  switch (model) {
    case RollingModel::type_a:
      return make_force_kernels<RollingModel::type_a>(arithmetic);
    case RollingModel::type_a_relative:
      return make_force_kernels<RollingModel::type_a_relative>(arithmetic);
    case RollingModel::type_c:
      return make_force_kernels<RollingModel::type_c>(arithmetic);
    case RollingModel::type_c_undamped:
      return make_force_kernels<RollingModel::type_c_undamped>(arithmetic);
  }
  return {};
}

}  // namespace repose
