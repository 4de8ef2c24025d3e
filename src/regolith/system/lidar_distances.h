// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "regolith/lio/scan_odometry.h"
#include "regolith/vio/lidar_depth.h"
#include "regolith/vio/visual_inertial_odometry.h"

namespace regolith {

/// The returns of a scan that lidar odometry has placed, for distances in its world.
void AddReturns(const ScanEstimate& estimate, const SE3& T_imu_lidar, LidarDepth* depth);

/// Distances for visual odometry from the scans that lidar odometry has placed. The returns lie in
/// the lidar's world, the camera in its own: the last scan whose pose both know joins the two.
class LidarDistances : public DistanceSource {
 public:
  LidarDistances(const LidarDepthOptions& options, const SE3& T_imu_lidar)
      : depth_(options), T_imu_lidar_(T_imu_lidar) {}

  /// What visual odometry says of the pose at a scan's stamp.
  void AddVisual(const StampedState& state) { visual_.push_back(state); }
  /// What lidar odometry says, with the scan's returns.
  void AddScan(const ScanEstimate& estimate);

  /// Nothing before there is a scan that both know.
  std::vector<std::optional<MeasuredDistance>> Distances(
      const SE3& T_world_camera, Span<const Eigen::Vector3d> bearings) override;

 private:
  LidarDepth depth_;
  SE3 T_imu_lidar_;
  std::deque<StampedState> visual_;
  std::optional<SE3> T_lidarworld_visualworld_;
};

}  // namespace regolith
