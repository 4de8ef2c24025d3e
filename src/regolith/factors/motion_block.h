// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/factors/pose_manifold.h"
#include "regolith/geometry/nav_state.h"

namespace regolith {

/// What a state of inertial navigation holds beside its pose, as a Ceres parameter block:
/// [velocity (world, m/s), gyro bias (rad/s), accelerometer bias (m/s²)].
inline constexpr int kMotionBlockSize = 9;
using MotionBlock = Eigen::Matrix<double, kMotionBlockSize, 1>;

inline MotionBlock ToMotionBlock(const NavState& state) {
  MotionBlock block;
  block << state.v_world_imu, state.gyro_bias, state.accelerometer_bias;
  return block;
}

/// The time is left at 0.
inline NavState FromBlocks(const double* pose, const double* motion) {
  NavState state;
  state.T_world_imu = FromPoseBlock(pose);
  state.v_world_imu = Eigen::Map<const Eigen::Vector3d>(motion);
  state.gyro_bias = Eigen::Map<const Eigen::Vector3d>(motion + 3);
  state.accelerometer_bias = Eigen::Map<const Eigen::Vector3d>(motion + 6);
  return state;
}

}  // namespace regolith
