#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/vec3.hpp"

namespace repose {

/// The order of points along a curve that fills space (Morton 1966: the bits of the three cell numbers in
/// turn), so that what is near in space is mostly near in memory. Points of one cell keep their order.
/// @param cell  edge of the cells [m], > 0; points more than 2²⁰ cells from the lowest share the last ones
/// @return indices of the points
std::vector<std::size_t> curve_order(std::span<const Vec3> points, double cell);

}  // namespace repose
