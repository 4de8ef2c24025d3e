// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/lidar_distances.h"

namespace regolith {

void AddReturns(const ScanEstimate& estimate, const SE3& T_imu_lidar, LidarDepth* depth) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(estimate.points.size());
  for (const MapPoint& point : estimate.points) points.push_back(point.position);
  depth->Add(estimate.stamp, points, estimate.T_world_body * T_imu_lidar.translation);
}

void LidarDistances::AddScan(const ScanEstimate& estimate) {
  while (!visual_.empty() && visual_.front().time < estimate.stamp) visual_.pop_front();
  if (!visual_.empty() && visual_.front().time == estimate.stamp) {
    T_lidarworld_visualworld_ = estimate.T_world_body * visual_.front().state.T_world_imu.Inverse();
  }
  AddReturns(estimate, T_imu_lidar_, &depth_);
}

std::vector<std::optional<MeasuredDistance>> LidarDistances::Distances(
    const SE3& T_world_camera, Span<const Eigen::Vector3d> bearings) {
  if (!T_lidarworld_visualworld_) {
    return std::vector<std::optional<MeasuredDistance>>(bearings.size());
  }
  return depth_.Distances(*T_lidarworld_visualworld_ * T_world_camera, bearings);
}

}  // namespace regolith
