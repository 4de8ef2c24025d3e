// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/span.h"
#include "regolith/imu/rest_detection_options.h"
#include "regolith/sensor/imu_sample.h"

namespace regolith {

/// Mean and standard deviation, axis by axis, of a window of inertial measurements.
struct ImuStatistics {
  int count = 0;
  double duration = 0.0;                                           ///< s
  Eigen::Vector3d mean_rate = Eigen::Vector3d::Zero();             ///< rad/s
  Eigen::Vector3d mean_specific_force = Eigen::Vector3d::Zero();   ///< m/s²
  Eigen::Vector3d sigma_rate = Eigen::Vector3d::Zero();            ///< rad/s, of one sample
  Eigen::Vector3d sigma_specific_force = Eigen::Vector3d::Zero();  ///< m/s², of one sample
};

/// Throws CheckError for fewer than two samples.
ImuStatistics ComputeImuStatistics(Span<const ImuSample> samples);

struct RestReport {
  bool at_rest = false;
  std::string reason;  ///< what spoke against rest, with figures; empty at rest
  ImuStatistics statistics;
};

/// Whether the imu stood still over the window. `gravity` is a magnitude in m/s².
RestReport DetectRest(Span<const ImuSample> samples, double gravity,
                      const RestDetectionOptions& options);

/// What a window at rest tells of the state.
struct RestState {
  Eigen::Quaterniond rotation_world_imu = Eigen::Quaterniond::Identity();  ///< yaw 0, world z up
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();                     ///< rad/s
  double gyro_bias_sigma = 0.0;  ///< rad/s, of the worst axis
  /// rad, from the spread of the samples alone: a bias of the accelerometer tilts as well.
  double tilt_sigma = 0.0;
  /// m/s², |mean force|: about 1 where the sensor reports units of g.
  double specific_force_norm = 0.0;
};

/// Gravity-aligned attitude, so that the imu's x axis has no heading, and the mean rate as bias.
/// Throws CheckError where the mean specific force is zero.
RestState InitializeAtRest(const ImuStatistics& statistics);

/// The rotation of yaw 0 that turns the direction `up_imu` (any length) onto world z: the heading
/// of the imu's x axis is world x; where x itself points up or down, that of its y axis is world y.
Eigen::Quaterniond RotationFromUp(const Eigen::Vector3d& up_imu);

}  // namespace regolith
