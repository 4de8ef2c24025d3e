// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regolith/cloud/voxel_map.h"
#include "regolith/lio/feature_scan_matcher.h"
#include "regolith/lio/lidar_odometry_options.h"

namespace regolith {

/// The ground around the rover as scans are matched with it: all their points, or edges and
/// planars alone (`features`).
class LocalMap {
 public:
  /// `rings` of the lidar, 0 without one: nothing is ever matched then.
  LocalMap(const LidarOdometryOptions& options, int rings);

  /// Begins anew.
  void Clear();
  bool is_new() const { return is_new_; }  ///< nothing is in it yet
  /// Of all points that came to be matched, those that lay beside a jump of the range.
  double ShareAtJumps() const;

  /// The pose of a scan, fused with a Gaussian prior [rotation (right), position] of it.
  /// `points_body`: the scan's points in their order, m, without motion distortion.
  ScanMatch Match(const LidarScan& scan, const std::vector<Eigen::Vector3d>& points_body,
                  const SE3& prior, const Matrix6d& prior_covariance, ThreadPool* threads);

  /// Adds the scan that was matched last. `points_map`: its points, m.
  void Extend(const std::vector<Eigen::Vector3d>& points_map, const SE3& T_map_body);

 private:
  LidarOdometryOptions options_;
  int rings_;
  std::vector<VoxelMap> voxels_;                ///< the same points, from fine to coarse
  std::vector<uint32_t> solid_;                 ///< of the scan matched last, off range jumps
  std::optional<FeatureScanMatcher> features_;  ///< in the place of `voxels_`
  bool is_new_ = true;
  size_t points_ = 0;
  size_t solid_points_ = 0;
};

}  // namespace regolith
