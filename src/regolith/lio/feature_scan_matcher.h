// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/lio/feature_map.h"
#include "regolith/lio/feature_scan_matcher_options.h"
#include "regolith/registration/scan_matcher.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Scan to map by the paper's features, edges on lines and planar points on planes (Zhang & Singh
/// 2014; Shan et al. 2020), in the place of planes through all points.
class FeatureScanMatcher {
 public:
  /// `rings` of the lidar.
  FeatureScanMatcher(const FeatureScanMatcherOptions& options, int rings);

  /// The pose of a scan, fused with a Gaussian prior [rotation (right), position] of it.
  /// `points_body`: the scan's points in their order, m, without motion distortion.
  ScanMatch Match(const LidarScan& scan, const std::vector<Eigen::Vector3d>& points_body,
                  const SE3& prior, const Matrix6d& prior_covariance, ThreadPool* threads);

  /// Adds the features of the scan that was matched last, at its pose.
  void Extend(const SE3& T_map_body);

 private:
  FeatureScanMatcherOptions options_;
  int rings_;
  FeatureMap map_;
  FeatureCloud cloud_body_;
};

}  // namespace regolith
