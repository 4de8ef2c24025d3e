// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// How the IMU turned between two times, from its gyro alone.
class GyroRotation {
 public:
  /// Samples in order of their stamps; a sample that is not later than the last is left out.
  void Add(const ImuSample& sample);
  /// rad/s, in the IMU's frame; 0 until it is set.
  void SetBias(const Eigen::Vector3d& gyro_bias) { gyro_bias_ = gyro_bias; }

  /// IMU frame at `end` into that at `start`. After the last sample its rate holds on. Nothing
  /// where more than 50 ms lie without a sample. Samples before `start` are forgotten: later calls
  /// start no earlier.
  std::optional<Eigen::Quaterniond> Between(TimeNs start, TimeNs end);

 private:
  std::deque<ImuSample> samples_;
  Eigen::Vector3d gyro_bias_ = Eigen::Vector3d::Zero();
};

}  // namespace regolith
