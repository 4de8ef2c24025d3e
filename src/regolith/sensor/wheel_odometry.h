// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// Dead reckoning of the wheels: drifts with slip, and its frame `odom` is arbitrary.
struct WheelOdometry {
  TimeNs time = 0;
  SE3 T_odom_base;
  Eigen::Vector3d linear_velocity_base = Eigen::Vector3d::Zero();   ///< m/s
  Eigen::Vector3d angular_velocity_base = Eigen::Vector3d::Zero();  ///< rad/s
};

}  // namespace regolith
