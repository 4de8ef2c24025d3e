// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "regolith/features/feature_set.h"
#include "regolith/sensor/rectified_camera.h"
#include "regolith/stereo/keypoint_patch.h"

namespace regolith {

/// The keypoints of a rectified pair: those of the left image, and where the right one has them.
struct StereoFeatures {
  static constexpr float kNotSeen = -1.0F;

  std::vector<Eigen::Vector2f> pixels;  ///< left image
  std::vector<float> right_columns;     ///< pixels, kNotSeen where the right image has none
  std::vector<float> scales;            ///< of the pyramid's level, 1 for the image itself
  bool has_scales = false;              ///< the extractor looks at a pyramid
  Descriptors descriptors;
  std::vector<KeypointPatch> patches;  ///< one a keypoint; empty: places are taken as they are
  /// DisparitySlopes, of a keyframe with patches.
  std::vector<Eigen::Vector2f> slopes;

  size_t size() const { return pixels.size(); }
  bool HasRight(size_t index) const { return right_columns[index] != kNotSeen; }
  double Depth(size_t index, const RectifiedCamera& camera) const {
    return camera.Depth(pixels[index].x() - right_columns[index]);
  }
  /// m, camera frame; for keypoints with a right column.
  Eigen::Vector3d Point(size_t index, const RectifiedCamera& camera) const {
    return camera.PointAt(pixels[index].cast<double>(), Depth(index, camera));
  }
  /// As RectifiedCamera::Project gives it.
  Eigen::Vector3d Seen(size_t index) const {
    return {pixels[index].x(), pixels[index].y(), right_columns[index]};
  }
};

}  // namespace regolith
