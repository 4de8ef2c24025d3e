// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/features/optical_flow.h"
#include "regolith/geometry/se3.h"
#include "regolith/sensor/camera_model.h"

namespace regolith {

/// Finds the features of a left image in the right image of the same time, by optical flow and the
/// known geometry of the pair; the images need not be rectified.
class StereoMatcher {
 public:
  /// `T_left_right`: right camera frame into the left one.
  StereoMatcher(const OpticalFlowOptions& options, const CameraIntrinsics& right,
                const SE3& T_left_right);

  /// One a feature: its unit bearing in the right camera. Nothing where it is not found, lies off
  /// its epipolar line by more than two pixels, or would lie behind the cameras.
  std::vector<std::optional<Eigen::Vector3d>> Match(const Image& left, const Image& right,
                                                    Span<const TrackedFeature> features);

 private:
  bool AgreesWithGeometry(const Eigen::Vector3d& left, const Eigen::Vector3d& right) const;

  OpticalFlow flow_;
  std::unique_ptr<CameraModel> right_;
  SE3 T_left_right_;
};

}  // namespace regolith
