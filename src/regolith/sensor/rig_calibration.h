// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "regolith/geometry/se3.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/imu_noise.h"

namespace regolith {

struct ImuCalibration {
  std::string topic = "/imu/data";
  double rate = 200.0;  ///< Hz, nominal
  ImuNoise noise;
};

struct LidarCalibration {
  std::string topic = "/velodyne_points";
  SE3 T_imu_lidar;
  int rings = 16;
  double time_offset = 0.0;   ///< s to add to its stamps to get the IMU's clock
  double period = 0.1;        ///< s a turn; used where firing times are derived
  double min_range = 0.5;     ///< m; nearer returns are the rover's own
  double max_range = 100.0;   ///< m
  double range_sigma = 0.02;  ///< m
  /// Elevation of the lowest and highest ring, degrees; used where `ring` is derived.
  double lowest_elevation_deg = -15.0;
  double highest_elevation_deg = 15.0;
};

struct CameraCalibration {
  std::string topic;
  CameraIntrinsics intrinsics;
  SE3 T_imu_camera;
  double time_offset = 0.0;        ///< s to add to its stamps to get the IMU's clock
  double time_offset_sigma = 0.0;  ///< s
  double rate = 10.0;              ///< Hz, nominal
  /// Image (PNG) as large as the camera's, 0 where the rover sees its own parts; empty: none.
  std::string mask_file;
};

struct WheelCalibration {
  std::string topic = "/odom";
  SE3 T_imu_base;
};

/// Everything about the sensors of one rover: what a rig file says. A sensor that the rover lacks
/// is absent.
struct RigCalibration {
  double gravity = 9.81;  ///< m/s²
  std::optional<ImuCalibration> imu;
  std::optional<LidarCalibration> lidar;
  std::map<std::string, CameraCalibration> cameras;  ///< by name: mono, left, right
  std::optional<WheelCalibration> wheels;

  /// Throws InputError that names the key and the value: gravity or noise of another unit, rates or
  /// ranges out of bounds, intrinsics that make no camera. (Rotations are checked where they are
  /// still matrices: TransformFromMatrix.)
  void Check() const;
};

/// Throws InputError (without a key) unless the upper left of a 4 × 4 transform is a rotation and
/// its last row is 0 0 0 1; says whether it is reflected, scaled or not orthogonal.
SE3 TransformFromMatrix(const Eigen::Matrix4d& matrix);

}  // namespace regolith
