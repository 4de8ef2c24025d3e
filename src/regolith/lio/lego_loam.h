// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/feature_map.h"
#include "regolith/lio/keyframe_graph.h"
#include "regolith/lio/lego_loam_options.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/lio/two_step_matcher.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

/// Lidar-only odometry and mapping after Shan & Englot 2018: segmentation, edge and planar
/// features, two-step scan-to-scan motion, refinement against a map of features, keyframes and loop
/// closure. Mapping refines every scan, so there is one trajectory and no second, slower one. The
/// world is the first body pose.
class LegoLoam final : public ScanOdometry {
 public:
  LegoLoam(const LegoLoamOptions& options, const RigCalibration& rig, ThreadPool* threads);

  std::vector<ScanEstimate> AddImu(const ImuSample& sample) override;
  std::vector<ScanEstimate> AddWheels(const WheelOdometry& odometry) override;
  std::vector<ScanEstimate> AddScan(const LidarScan& scan) override;
  std::vector<ScanEstimate> Finish() override;
  std::optional<Trajectory> Refined() const override;
  KeyframeCounts Counts() const override;
  std::vector<std::string> Notices() const override;

 private:
  /// A scan's pose relative to a keyframe, so that it follows when loops move that.
  struct ScanPose {
    TimeNs stamp = 0;
    size_t keyframe = 0;
    SE3 T_keyframe_lidar;  ///< at the stamp
  };

  ScanEstimate Estimate(const LidarScan& scan);
  std::vector<Eigen::Vector3d> RemoveMotion(const LidarScan& scan, TimeNs reference) const;
  void Track(const SE3& T_map_lidar, TimeNs time);
  void Extend(const FeatureCloud& cloud, TimeNs time);
  void RebuildMap();
  SE3 ToBody(const SE3& T_map_lidar) const;
  Matrix6d BodyCovariance(const MapMatch& match) const;

  LegoLoamOptions options_;
  LidarCalibration lidar_;
  Eigen::Vector3d up_lidar_;  ///< the body's z axis
  ThreadPool* threads_;

  FeatureTarget last_features_;
  std::optional<StampedPose> last_;             ///< T_map_lidar at the middle of the last sweep
  Vector6d velocity_lidar_ = Vector6d::Zero();  ///< [rad/s, m/s], between the last two
  FeatureMap map_;
  KeyframeGraph graph_;
  std::vector<ScanPose> scan_poses_;

  size_t empty_scans_ = 0;
  size_t late_scans_ = 0;
  size_t guessed_scans_ = 0;
  size_t reordered_scans_ = 0;
  size_t invalid_points_ = 0;
};

}  // namespace regolith
