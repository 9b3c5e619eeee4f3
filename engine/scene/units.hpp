#pragma once

namespace repose {

// Lengths and volumes of a case in SI. Division, so that 195 mm is the double nearest to 0.195 m.
constexpr double from_mm(double millimetres) { return millimetres / 1e3; }
constexpr double from_mm3(double cubic_millimetres) { return cubic_millimetres / 1e9; }
constexpr double to_mm(double metres) { return metres * 1e3; }

}  // namespace repose
