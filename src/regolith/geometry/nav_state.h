// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// What inertial navigation knows at one time. Error order: [rotation (right, rad), position
/// (world, m), velocity (world, m/s), gyro bias (rad/s), accelerometer bias (m/s²)].
struct NavState {
  TimeNs time = 0;
  SE3 T_world_imu;
  Eigen::Vector3d v_world_imu = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();
};

}  // namespace regolith
