// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "regolith/core/span.h"

namespace regolith {

/// The least-squares plane of a few points and how plane they are.
struct PlaneFit {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit; its sign is arbitrary
  /// Principal axes as columns: the normal, then the two within the plane.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// Variances along these axes, ascending, m².
  Eigen::Vector3d variances = Eigen::Vector3d::Zero();
};

/// Fits a plane to at least three points by the eigenvectors of their covariance.
PlaneFit FitPlane(Span<const Eigen::Vector3d> points);

}  // namespace regolith
