// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/inertial_tracker.h"
#include "regolith/lio/lidar_odometry_options.h"
#include "regolith/lio/local_map.h"
#include "regolith/lio/map_drift.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

/// Lidar–inertial odometry: the IMU removes the scan's motion distortion and, with the wheels,
/// predicts its pose; planes of the map around correct it; the filter learns velocity, biases,
/// gravity and the wheels' slip from the correction. Without an IMU the wheels are the guess, or
/// the last motion. Without the lidar (or in a time without scans, where poses are asked for by
/// AddStamp) IMU, wheels and told velocities go alone. The body is the IMU where there is one; the
/// world is level there, with its origin at the first IMU pose; else it is the first body pose.
class LidarOdometry : public ScanOdometry {
 public:
  LidarOdometry(const LidarOdometryOptions& options, const RigCalibration& rig,
                ThreadPool* threads);

  /// A scan is estimated as soon as the IMU has reached its end. Throws InputError where the IMU's
  /// units or the rig's gravity cannot be right.
  std::vector<ScanEstimate> AddImu(const ImuSample& sample) override;
  std::vector<ScanEstimate> AddWheels(const WheelOdometry& odometry) override;
  void AddVelocity(const BodyVelocity& velocity) override;
  std::vector<ScanEstimate> AddScan(const LidarScan& scan) override;
  std::vector<ScanEstimate> AddStamp(TimeNs time) override;
  std::vector<ScanEstimate> Finish() override;
  std::vector<std::string> Notices() const override;

 private:
  /// A pose before a scan is matched, and how far it is trusted.
  struct Guess {
    SE3 T_world_body;
    Matrix6d covariance = Matrix6d::Identity();
  };

  /// A scan, or a time at which a pose is wanted without one.
  struct Waiting {
    LidarScan scan;
    bool is_scan = true;
  };

  std::vector<ScanEstimate> EstimateReady(bool all);
  void GiveUpImu(bool all);
  void TakeUpImu(const ImuSample& sample);
  bool CanEstimate(const Waiting& waiting);
  bool IsReady(const LidarScan& scan) const;
  ScanEstimate EstimateInertial(const LidarScan& scan);
  ScanEstimate EstimateWithoutImu(const LidarScan& scan);
  Guess GuessAt(TimeNs time) const;
  ScanMatch Match(const LidarScan& scan, const std::vector<Eigen::Vector3d>& points_body,
                  const Guess& guess);
  void BeginMapWhereLost();
  void AddDrift(const SE3& T_world_body, ScanEstimate* estimate);
  std::vector<MapPoint> ExtendMap(const LidarScan& scan,
                                  const std::vector<Eigen::Vector3d>& points_body,
                                  const SE3& T_world_body);

  LidarOdometryOptions options_;
  RigCalibration rig_;
  SE3 T_body_lidar_;
  std::optional<SE3> T_body_base_;  ///< of the wheels, where they are used
  ThreadPool* threads_;
  LocalMap map_;
  MapDrift drift_;
  std::optional<SE3> last_pose_;  ///< that `drift_` has reached
  bool is_placed_ = false;        ///< by a match of the scan before
  std::deque<Waiting> waiting_;
  std::optional<InertialTracker> inertial_;      ///< nothing without an IMU
  std::optional<InertialTracker> unusable_imu_;  ///< too slow an IMU, for its notice
  std::optional<InertialTracker> silent_imu_;    ///< that was given up and may come back

  // Without an IMU.
  std::optional<StampedPose> last_;            ///< at the middle of the last sweep
  Vector6d velocity_body_ = Vector6d::Zero();  ///< [rad/s, m/s], between the last two
  std::vector<WheelOdometry> wheels_;          ///< from `last_` on

  bool wheels_came_ = false;
  bool imu_was_silent_ = false;
  std::optional<TimeNs> last_stamp_;
  size_t scans_ = 0;
  size_t invalid_points_ = 0;
  size_t empty_scans_ = 0;
  size_t early_scans_ = 0;
  size_t unmatched_scans_ = 0;
  size_t repeated_scans_ = 0;
  size_t maps_begun_ = 0;
};

}  // namespace regolith
