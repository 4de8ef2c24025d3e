// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/time.h"
#include "regolith/geometry/se3.h"
#include "regolith/vio/lidar_depth_options.h"

namespace regolith {

struct MeasuredDistance {
  double distance = 0.0;  ///< m, along the bearing
  double sigma = 0.0;     ///< m
};

/// What measures the distances of features beside the window's own images.
class DistanceSource {
 public:
  virtual ~DistanceSource() = default;

  /// One a bearing (unit, camera frame), where there is one. The pose is that of the camera in the
  /// world of visual odometry.
  virtual std::vector<std::optional<MeasuredDistance>> Distances(
      const SE3& T_world_camera, Span<const Eigen::Vector3d> bearings) = 0;
};

/// Distances of features from the lidar returns of the last scans: a scan of 16 rings alone sees no
/// ground nearer than 4.5 m, where a rover's best features are (Shan et al. 2021, section III-B2,
/// with an occlusion test and an error of its own for each).
class LidarDepth : public DistanceSource {
 public:
  explicit LidarDepth(const LidarDepthOptions& options);

  /// Returns of one scan (world, motion compensated), and where the lidar was.
  void Add(TimeNs time, Span<const Eigen::Vector3f> points_world,
           const Eigen::Vector3d& lidar_world);

  /// One a bearing (unit, camera frame): the distance at which it meets the surface seen there.
  /// Nothing where there are too few returns around it, or they lie in no plane.
  std::vector<std::optional<MeasuredDistance>> Distances(
      const SE3& T_world_camera, Span<const Eigen::Vector3d> bearings) override;

  size_t scans() const { return scans_.size(); }

 private:
  struct Scan {
    TimeNs time = 0;
    Eigen::Vector3d lidar_world;
    double way = 0.0;  ///< m, gone until then
    std::vector<Eigen::Vector3f> points_world;
  };
  /// A return as the camera would see it.
  struct Return {
    Eigen::Vector3f point_camera;
    Eigen::Vector2f place;  ///< x / z, y / z
  };

  void Project(const SE3& T_world_camera);
  std::optional<MeasuredDistance> DistanceOf(const Eigen::Vector3d& bearing) const;
  std::vector<Eigen::Vector3d> NearestReturns(const Eigen::Vector3d& bearing) const;
  int CellOf(float coordinate) const;

  LidarDepthOptions options_;
  std::deque<Scan> scans_;
  std::vector<Return> returns_;       ///< sorted by their cells
  std::vector<uint32_t> cell_begin_;  ///< in `returns_`, of each cell and one beyond
  int cells_;                         ///< along each side of the grid
};

}  // namespace regolith
