// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/lio/curvature_features.h"
#include "regolith/lio/ring_search.h"
#include "regolith/lio/segmentation_options.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Which points of a scan are features, and what they belong to (Shan & Englot 2018, III-B and C).
struct SegmentedScan {
  PointLabels labels;
  std::vector<int> rows;  ///< of the points' rings from the lowest; -1 where the image lacks them
  CurvatureFeatures features;
  bool rings_reordered = false;
  int invalid_points = 0;
};

/// `rings`: of the lidar; `up_lidar`: the rover's own up in its frame.
SegmentedScan SegmentScan(const LidarScan& scan, int rings, const Eigen::Vector3d& up_lidar,
                          const SegmentationOptions& options);

/// The features' positions at one instant, m, lidar frame.
struct ScanFeatures {
  std::vector<RingPoint> sharp_edges;
  std::vector<RingPoint> edges;
  std::vector<RingPoint> flat_planars;     ///< of the ground
  std::vector<RingPoint> ground_planars;   ///< one a voxel of the thinning
  std::vector<RingPoint> cluster_planars;  ///< the same
};

/// `points_lidar`: the whole scan without motion distortion, in its order. Planars are thinned to
/// one a voxel of edge `voxel_size` (m): the next beam along a ring says nothing new.
ScanFeatures PlaceFeatures(const SegmentedScan& segmented, Span<const Eigen::Vector3d> points_lidar,
                           double voxel_size);

}  // namespace regolith
