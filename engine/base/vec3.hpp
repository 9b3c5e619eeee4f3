#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace repose {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Unit quaternion (w, x, y, z), body to world.
using Quat = Eigen::Quaterniond;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kGravity = 9.81;  ///< g [m/s²], along −z (article section 3.2)

inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
inline constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace repose
