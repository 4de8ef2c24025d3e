// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "regolith/core/random.h"
#include "regolith/sensor/wheel_odometry.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// Mean slip of the wheels, 1 - ground speed / wheel speed, where the ground rises by `slope` rad
/// along the motion: the table uphill, a skid half as strong as its growth downhill.
double MeanSlip(const WheelOptions& options, double slope);

/// Dead reckoning from wheel turns: slip, wheels of the wrong radius, too much yaw in point turns.
/// Planar, as rovers' odometry is: frame `odom` has its z along the base's at the start.
class WheelSimulator {
 public:
  WheelSimulator(const WheelOptions& options, uint64_t seed);

  /// The next measurement, at the motion (without vibration) of its time; measurements are 1 / rate
  /// apart. The stamp is left to the caller.
  WheelOdometry Measure(const MotionState& motion);

 private:
  WheelOptions options_;
  Random random_;
  double radius_scale_;
  double turn_scale_;
  double slip_deviation_ = 0.0;  ///< in units of its standard deviation
  bool started_ = false;
  double previous_speed_ = 0.0;
  double previous_yaw_rate_ = 0.0;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  double yaw_ = 0.0;
};

}  // namespace regolith
