// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/cloud/voxel_map.h"
#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/se3.h"
#include "regolith/registration/point_to_plane_options.h"

namespace regolith {

/// The quadratic form ½ δᵀ information δ + gradientᵀ δ of a scan's cost around a pose, with δ as in
/// Plus(pose, δ): [rotation (right, rad), position (m)].
struct PointToPlaneSystem {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  /// What `information` would be in the mean if the normals pointed all ways that their own errors
  /// let them: as much of it is noise.
  Matrix6d noise = Matrix6d::Zero();
  int points = 0;        ///< points tried
  int matches = 0;       ///< points with a plane
  double inliers = 0.0;  ///< sum of the robust weights
  double scale = 0.0;    ///< m, robust standard deviation of the residuals
};

/// The plane of the map that a scan's point was matched to.
struct PlaneMatch {
  bool searched = false;
  bool valid = false;
  Eigen::Vector3d searched_at = Eigen::Vector3d::Zero();  ///< m, map: where the point lay then
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();     ///< m, map
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();      ///< map
  double thickness_squared = 0.0;  ///< m², of the neighbourhood across its plane
  /// What the normal may be off by, 1 σ (rad), along the two principal axes within the plane.
  Eigen::Vector3d normal_error_minor = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_error_major = Eigen::Vector3d::Zero();
};

/// Matches each point (m, body frame) to the plane through its nearest map points. `maps` hold the
/// same points from fine to coarse voxels: the first in which the neighbourhood is a plane is
/// taken, so that dense ground is met locally and the sparse rings of far walls still make planes.
/// Planes of an earlier search in `planes` are kept where the point has hardly moved since; an
/// empty `planes` is filled.
void FindPlanes(Span<const Eigen::Vector3d> points_body, const SE3& T_map_body,
                Span<const VoxelMap> maps, const PointToPlaneOptions& options, ThreadPool* threads,
                std::vector<PlaneMatch>* planes);

/// Linearises the residuals r = nᵀ(T p - c) with Geman–McClure weights, whose scale is estimated
/// from the residuals themselves (1.4826 · median |r|). Sums are the same for any number of
/// threads.
PointToPlaneSystem LinearizePointToPlane(Span<const Eigen::Vector3d> points_body,
                                         Span<const PlaneMatch> planes, const SE3& T_map_body,
                                         const PointToPlaneOptions& options, ThreadPool* threads);

}  // namespace regolith
