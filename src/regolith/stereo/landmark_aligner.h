// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// How the disparity changes around each keypoint, pixels a pixel along columns and rows: the plane
/// through the disparities of the keypoints around it, which is that of the ground. 0 where few are
/// known.
std::vector<Eigen::Vector2f> DisparitySlopes(const StereoFeatures& features);

/// Moves a keypoint along ground whose disparity has this slope.
void MovePlace(const Eigen::Vector2f& place, const Eigen::Vector2f& slope, size_t row,
               StereoFeatures* features);

/// Moves keypoints to where their landmarks are to a fraction of a pixel, by what the images look
/// like around them (KeypointPatch), for detectors that say it less exactly. Features without
/// patches stay as they are.
class LandmarkAligner {
 public:
  LandmarkAligner(const PatchAlignmentOptions& options, const RectifiedCamera& camera)
      : options_(options), camera_(camera) {}

  /// Moves keypoint `row` of `features`, seen from `T_world_camera`, to the point that is feature
  /// `from_row` of a keyframe. False where the two do not look alike.
  bool Align(const StereoKeyframe& from, size_t from_row, const Eigen::Vector3d& point_world,
             const SE3& T_world_camera, StereoFeatures* features, size_t row) const;

  /// To the landmark as its newest keyframe saw it.
  bool Align(const StereoMap& map, const StereoLandmark& landmark, const SE3& T_world_camera,
             StereoFeatures* features, size_t row) const;

 private:
  PatchAlignmentOptions options_;
  RectifiedCamera camera_;
};

}  // namespace regolith
