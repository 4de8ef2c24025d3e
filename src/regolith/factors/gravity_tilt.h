// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/geometry/so3.h"

namespace regolith {

/// The direction of gravity as a parameter block of two values (rad): how far it is tilted about
/// the world's x and y from -z. The world is level as far as the first samples told; what the
/// accelerometer's bias hid of that is learnt here, and what was built before stays where it is.
inline constexpr int kTiltBlockSize = 2;

/// m/s², world. `magnitude`: m/s².
inline Eigen::Vector3d GravityFromTilt(const Eigen::Vector2d& tilt, double magnitude) {
  return ExpSo3({tilt.x(), tilt.y(), 0.0}) * Eigen::Vector3d(0.0, 0.0, -magnitude);
}

/// The tilt of a gravity vector (world) that is not far from straight down.
inline Eigen::Vector2d TiltOfGravity(const Eigen::Vector3d& gravity_world) {
  return LogSo3(RotationBetween(-Eigen::Vector3d::UnitZ(), gravity_world.normalized())).head<2>();
}

inline Eigen::Matrix<double, 3, 2> GravityTiltJacobian(const Eigen::Vector2d& tilt,
                                                       double magnitude) {
  const Eigen::Vector3d rotation(tilt.x(), tilt.y(), 0.0);
  const Eigen::Matrix3d jacobian = -ExpSo3(rotation).toRotationMatrix() *
                                   Hat(Eigen::Vector3d(0.0, 0.0, -magnitude)) *
                                   RightJacobianSo3(rotation);
  return jacobian.leftCols<2>();
}

}  // namespace regolith
