// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "regolith/core/random.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// What a perfect IMU measures: body rate and specific force Rᵀ (a - g), gravity (m/s²) along -z.
ImuSample ExactImu(const MotionState& motion, double gravity);

/// An IMU whose axes have scale errors and are not quite square to each other, with white noise and
/// biases that walk (Crassidis 2006: densities over the square root of the sampling interval).
class ImuSimulator {
 public:
  ImuSimulator(const ImuOptions& options, double gravity, uint64_t seed);

  /// The next sample, at the motion of its time; samples are 1 / rate apart. The stamp is left to
  /// the caller.
  ImuSample Measure(const MotionState& motion);

  /// What a sensor without bias and noise makes of a true vector (frame `imu`): 1 + scale errors on
  /// the diagonal, beside it the angles (rad) of the sensor's axes towards the others.
  const Eigen::Matrix3d& gyro_axes() const { return gyro_axes_; }
  const Eigen::Matrix3d& accelerometer_axes() const { return accelerometer_axes_; }

 private:
  Eigen::Vector3d Gaussian(double sigma);

  ImuOptions options_;
  double gravity_;
  Random random_;
  Eigen::Matrix3d gyro_axes_;
  Eigen::Matrix3d accelerometer_axes_;
  Eigen::Vector3d gyro_bias_;
  Eigen::Vector3d accelerometer_bias_;
};

}  // namespace regolith
