// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/cloud/map_point.h"
#include "regolith/core/stopwatch.h"
#include "regolith/geometry/nav_state.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/registration/scan_matcher.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/lidar_scan.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// Where a rover is and what its IMU does, as an inertial odometry knows it.
struct InertialState {
  NavState state;
  Eigen::Vector3d gravity_world = Eigen::Vector3d::Zero();  ///< m/s²
};

/// A velocity that another sensor tells, such as a camera.
struct BodyVelocity {
  TimeNs time = 0;
  Eigen::Vector3d velocity_imu = Eigen::Vector3d::Zero();  ///< m/s, IMU's frame
  double sigma = 0.0;                                      ///< m/s, each axis
};

/// What an odometry says of one scan.
struct ScanEstimate {
  TimeNs stamp = 0;
  SE3 T_world_body;                        ///< at the scan's stamp
  Matrix6d covariance = Matrix6d::Zero();  ///< of the pose at the scan's end
  /// "lidar+imu", "camera+imu", "wheels+imu", "imu", "lidar", "wheels", "guess".
  std::string leader;
  bool has_scan = true;  ///< false: asked for by AddStamp
  bool at_rest = false;
  std::optional<InertialState> inertial;  ///< at the scan's end; nothing without an IMU
  ScanMatch match;
  std::vector<MapPoint> points;  ///< world, all of the scan without motion distortion
  std::vector<StageTime> stages;
};

/// Of an odometry that closes loops.
struct KeyframeCounts {
  size_t keyframes = 0;
  size_t loops_accepted = 0;
  size_t loops_rejected = 0;
};

/// Makes a pose of every lidar scan. Measurements come in order of their stamps; each call returns
/// the scans that it completed, in their order, mostly none.
class ScanOdometry {
 public:
  virtual ~ScanOdometry() = default;

  virtual std::vector<ScanEstimate> AddImu(const ImuSample& sample) = 0;
  virtual std::vector<ScanEstimate> AddWheels(const WheelOdometry& odometry) = 0;
  /// Helps where the lidar does not tell; an odometry may leave it aside.
  virtual void AddVelocity(const BodyVelocity& velocity) { (void)velocity; }
  virtual std::vector<ScanEstimate> AddScan(const LidarScan& scan) = 0;
  /// Asks for a pose at a time without a scan, in the order of the scans' stamps. Nothing comes of
  /// it where no other sensor tells the motion.
  virtual std::vector<ScanEstimate> AddStamp(TimeNs time) {
    (void)time;
    return {};
  }

  /// Estimates what still waits for measurements that never came.
  virtual std::vector<ScanEstimate> Finish() = 0;

  /// The best poses known now, at the stamps of the estimates given out so far. Nothing where these
  /// are the estimates themselves.
  virtual std::optional<Trajectory> Refined() const { return std::nullopt; }

  virtual KeyframeCounts Counts() const { return {}; }

  /// What a user should know, a line each: gaps bridged, scans without points.
  virtual std::vector<std::string> Notices() const = 0;
};

}  // namespace regolith
