// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"

namespace regolith {

struct AbsolutePoseOptions {
  int iterations = 300;        ///< of RANSAC
  double angle_error = 0.006;  ///< rad, of an inlier (in the image plane at unit depth)
  int min_inliers = 15;
};

struct AbsolutePose {
  SE3 T_camera_points;       ///< the points' frame into the camera's
  std::vector<int> inliers;  ///< indices of the points that agree
};

/// The pose of a camera that sees known points (m) along bearings (unit, camera frame): EPnP in
/// RANSAC (Lepetit et al. 2009), then least squares over what agrees. The same on every run.
/// Bearings sideways or behind are left out. Nothing where too few agree.
std::optional<AbsolutePose> EstimateAbsolutePose(Span<const Eigen::Vector3d> points,
                                                 Span<const Eigen::Vector3d> bearings,
                                                 const AbsolutePoseOptions& options);

}  // namespace regolith
