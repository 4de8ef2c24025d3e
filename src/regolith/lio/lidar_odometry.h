// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "regolith/cloud/voxel_map.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/inertial_filter.h"
#include "regolith/lio/lidar_odometry_options.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

/// Lidar–inertial odometry: the IMU removes the scan's motion distortion and predicts its pose;
/// planes of the map around correct it; the filter learns velocity, biases and gravity from the
/// correction. Without an IMU the last motion is the guess. The body is the IMU where there is one;
/// the world is level there, with its origin at the first IMU pose; else it is the first body pose.
class LidarOdometry : public ScanOdometry {
 public:
  LidarOdometry(const LidarOdometryOptions& options, const RigCalibration& rig,
                ThreadPool* threads);

  /// Measurements in order of their stamps. A scan is estimated as soon as the IMU has reached its
  /// end. Throws InputError where the IMU's units or the rig's gravity cannot be right.
  std::vector<ScanEstimate> AddImu(const ImuSample& sample) override;
  std::vector<ScanEstimate> AddWheels(const WheelOdometry& odometry) override;
  std::vector<ScanEstimate> AddScan(const LidarScan& scan) override;
  std::vector<ScanEstimate> Finish() override;
  std::vector<std::string> Notices() const override;

 private:
  struct Gap {
    TimeNs begin = 0;
    TimeNs end = 0;
  };

  std::vector<ScanEstimate> EstimateReady(bool all);
  bool IsReady(const LidarScan& scan) const;
  void Initialize();
  void CheckGravity(const ImuStatistics& statistics) const;
  ScanEstimate EstimateInertial(const LidarScan& scan);
  ScanEstimate EstimateLidarOnly(const LidarScan& scan);
  std::vector<StampedPose> PropagateTo(TimeNs end);
  void PropagateStep(const ImuSample& from, const ImuSample& to);
  std::optional<ImuStatistics> RestStatistics(TimeNs time) const;
  ScanMatch Match(const std::vector<Eigen::Vector3d>& points_body, const SE3& prior,
                  const Matrix6d& covariance);
  std::vector<MapPoint> ExtendMap(const LidarScan& scan,
                                  const std::vector<Eigen::Vector3d>& points_body,
                                  const SE3& T_world_body);

  LidarOdometryOptions options_;
  RigCalibration rig_;
  SE3 T_body_lidar_;
  ThreadPool* threads_;
  std::vector<VoxelMap> maps_;  ///< the same points, from fine to coarse voxels
  std::deque<LidarScan> waiting_;

  // With an IMU.
  std::vector<ImuSample> samples_;  ///< from a rest window before the filter's time on
  std::deque<Gap> gaps_;
  std::optional<InertialFilter> filter_;

  // Without one.
  std::optional<StampedPose> last_;            ///< at the middle of the last sweep
  Vector6d velocity_body_ = Vector6d::Zero();  ///< [rad/s, m/s], between the last two

  size_t scans_ = 0;
  size_t empty_scans_ = 0;
  size_t early_scans_ = 0;
  size_t gap_count_ = 0;
  double longest_gap_ = 0.0;
  std::string start_notice_;
};

}  // namespace regolith
