// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "regolith/cloud/voxel_map.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/registration/degeneracy.h"
#include "regolith/registration/point_to_plane.h"
#include "regolith/registration/scan_matcher_options.h"

namespace regolith {

struct ScanMatch {
  SE3 T_map_body;
  Matrix6d covariance = Matrix6d::Identity();  ///< [rotation (right), position]
  bool used_scan = false;  ///< false: too few matches, pose and covariance are the prior's
  int searches = 0;
  PointToPlaneSystem system;    ///< at the last linearisation
  ObservableSystem observable;  ///< what of it was used
};

/// The most probable pose given a Gaussian prior and a scan (points in m, body frame): Gauss–Newton
/// on the sum of the prior's and the planes' squared errors. Directions that the scan does not see
/// stay as the prior has them, and those that it seems to see by noise alone too.
ScanMatch MatchScan(Span<const Eigen::Vector3d> points_body, const SE3& prior,
                    const Matrix6d& prior_covariance, Span<const VoxelMap> maps,
                    const ScanMatcherOptions& options, ThreadPool* threads);

}  // namespace regolith
