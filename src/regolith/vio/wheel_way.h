// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/span.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// How far the wheels went, turned by the gyro: wheels measure a way well and turns badly.
struct WheelWay {
  Eigen::Vector3d way_base = Eigen::Vector3d::Zero();  ///< m, base frame at the start
  double length = 0.0;                                 ///< m, along the track
  double angle = 0.0;                                  ///< rad, sum of all turning
};

/// The way from the first to the last of `samples`. `wheels` are sorted and cover that time, else
/// nothing is returned. The steps of their poses count, not their twist, which may be empty.
/// `R_imu_base`: base frame into the IMU's. `gyro_bias` in rad/s.
std::optional<WheelWay> IntegrateWheelWay(Span<const WheelOdometry> wheels,
                                          Span<const ImuSample> samples,
                                          const Eigen::Quaterniond& R_imu_base,
                                          const Eigen::Vector3d& gyro_bias);

}  // namespace regolith
