// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/core/time.h"

namespace regolith {

/// What an IMU measures at one time, in its own frame.
struct ImuSample {
  TimeNs time = 0;
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();    ///< m/s²; at rest it points up
};

}  // namespace regolith
