// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "regolith/core/span.h"
#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"
#include "regolith/imu/wheel_preintegration_options.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// Motion of the base between two times by its wheels.
struct WheelDelta {
  TimeNs start_time = 0;
  TimeNs end_time = 0;
  SE3 T_from_to;
  double distance = 0.0;  ///< m, along the track
  double angle = 0.0;     ///< rad, sum of all turning
  /// Of T_from_to as Plus() perturbs it: [rotation in the last base frame, position in the first].
  Matrix6d covariance = Matrix6d::Identity();
};

/// The motion from `start` to `end`, interpolated in a sorted series of wheel odometry. Nothing
/// where the series does not cover both times; throws CheckError unless start < end.
std::optional<WheelDelta> PreintegrateWheels(Span<const WheelOdometry> odometry, TimeNs start,
                                             TimeNs end, const WheelPreintegrationOptions& options);

}  // namespace regolith
