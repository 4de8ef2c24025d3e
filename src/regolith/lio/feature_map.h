// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/cloud/voxel_map.h"
#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/lio/feature_map_options.h"
#include "regolith/lio/feature_problem.h"

namespace regolith {

/// Edge and planar points without order, m, in one frame.
struct FeatureCloud {
  std::vector<Eigen::Vector3d> edges;
  std::vector<Eigen::Vector3d> planars;
};

struct MapMatch {
  SE3 T_map_lidar;
  bool used_scan = false;         ///< false: too few matches, the pose is the guess
  int degenerate_directions = 0;  ///< that keep the guess
  FeatureSystem system;           ///< at the last linearisation
  double scale = 0.0;             ///< m, robust standard deviation of the distances
};

/// Edges and planars of many scans around the lidar, and the refinement of a pose against them
/// (Zhang & Singh 2014, section VI; Shan & Englot 2018, section III-E).
class FeatureMap {
 public:
  explicit FeatureMap(const FeatureMapOptions& options);

  void Add(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar);
  void ForgetFarFrom(const Eigen::Vector3d& centre);
  bool empty() const { return edges_.empty() && planars_.front().empty(); }

  /// The pose near the guess that brings the features onto the lines and planes of the map.
  /// Directions that they do not determine keep the guess.
  MapMatch Match(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar_guess,
                 ThreadPool* threads) const;

 private:
  FeatureMatches Search(const FeatureCloud& cloud_lidar, const SE3& T_map_lidar,
                        ThreadPool* threads) const;
  FeatureLine FindLine(const Eigen::Vector3d& point_map) const;
  FeaturePlane FindPlane(const Eigen::Vector3d& point_map) const;

  FeatureMapOptions options_;
  VoxelMap edges_;
  std::vector<VoxelMap> planars_;  ///< the same points, in fine and in coarse voxels
};

}  // namespace regolith
