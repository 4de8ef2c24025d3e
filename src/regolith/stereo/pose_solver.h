// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/rectified_camera.h"
#include "regolith/stereo/stereo_features.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// A known point and where a rectified pair saw it.
struct PointSighting {
  Eigen::Vector3d point_world = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();  ///< pixels, as RectifiedCamera::Project gives it
  bool has_right = false;                          ///< the third of them too
  double sigma = 1.0;                              ///< pixels, of the left column and row
  double disparity_sigma = 1.0;                    ///< pixels

  /// Errors of RectifiedCamera::Project into standard deviations; what was not seen has none.
  Eigen::Matrix3d Whitening() const;
};

/// Feature `row` as a sighting of a point.
PointSighting SightingOf(const StereoFeatures& features, size_t row,
                         const Eigen::Vector3d& point_world, const SightingNoise& noise);

/// χ² of one sighting (two or three values), above which one in twenty true ones lies.
inline double OutlierThreshold(bool has_right) { return has_right ? 7.815 : 5.991; }

/// Squared error of a sighting in standard deviations; infinite behind the camera.
double SquaredError(const RectifiedCamera& camera, const SE3& T_camera_world,
                    const PointSighting& sighting);

struct PoseSolution {
  SE3 T_world_camera;
  std::vector<uint8_t> inliers;  ///< one a sighting
  size_t inlier_count = 0;
};

/// The pose from which known points are seen so (motion-only bundle adjustment, Mur-Artal & Tardós
/// 2017, equation 1): least squares with Huber's loss, in rounds between which outliers are taken
/// out or back in.
PoseSolution SolvePose(const RectifiedCamera& camera, Span<const PointSighting> sightings,
                       const SE3& T_world_camera);

}  // namespace regolith
