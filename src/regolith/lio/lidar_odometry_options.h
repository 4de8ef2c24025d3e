// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/cloud/voxel_map_options.h"
#include "regolith/imu/rest_detection_options.h"
#include "regolith/imu/wheel_preintegration_options.h"
#include "regolith/lio/feature_scan_matcher_options.h"
#include "regolith/lio/inertial_filter_options.h"
#include "regolith/lio/map_drift_options.h"
#include "regolith/lio/range_jumps_options.h"
#include "regolith/registration/scan_matcher_options.h"

namespace regolith {

struct LidarOdometryOptions {
  bool lidar = true;      ///< false: IMU and wheels alone
  bool imu = true;        ///< false: lidar alone, guess from wheels or constant velocity
  bool wheels = false;    ///< where the rig has them
  bool features = false;  ///< match edges and planars (feature_matcher), not all points (matcher)
  VoxelMapOptions map;    ///< the finest; each coarser one has voxels `map_growth` times as large
  int map_levels = 2;
  double map_growth = 3.0;
  RangeJumpOptions range_jumps;  ///< points there are left out, where all are matched
  ScanMatcherOptions matcher;
  FeatureScanMatcherOptions feature_matcher;
  double scan_voxel_size = 0.35;  ///< m, one point a voxel is matched
  int max_points = 6000;          ///< more than these are thinned further
  MapDriftOptions drift;
  /// m, 1 σ: a rover that has not been placed by the scan before and may be farther off than this
  /// begins a new map, since in the old one it might be placed wrongly.
  double max_lost_sigma = 1.0;
  double initialization_window = 1.0;  ///< s of IMU samples that start the filter
  RestDetectionOptions rest;
  double rest_window = 0.5;  ///< s of IMU samples that must be still to say that the rover stands
  double rest_max_speed = 0.03;  ///< m/s, a faster estimate says that it does not
  double rest_max_rate = 0.005;  ///< rad/s, off the gyro's bias: a faster turn says so too
  InertialFilterOptions filter;
  /// Without an IMU, 1 σ of what the motion between two scans may differ from that before.
  double velocity_rotation_sigma = 0.05;    ///< rad
  double velocity_position_sigma = 0.3;     ///< m
  WheelPreintegrationOptions wheel_motion;  ///< without an IMU
  double min_imu_rate = 50.0;               ///< Hz; a slower IMU is reported and not used
  double max_imu_gap = 0.1;  ///< s between samples; a longer one is bridged by constant velocity

  /// Throws CheckError on values that make no odometry.
  void Check() const;
};

}  // namespace regolith
