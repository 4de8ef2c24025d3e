// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "regolith/geometry/se3.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/image.h"
#include "regolith/sensor/rectified_camera.h"

namespace regolith {

/// Turns the images of any two cameras of a rig into those of a rectified pair: new axes with x
/// along the baseline and z as near to both optical axes as that allows, the smaller of the two
/// focal lengths, images of the left camera's size.
class StereoRectifier {
 public:
  /// `T_left_right`: right camera frame into the left one. Throws InputError where
  /// the right camera stands behind or left of the left one, so that no rectified pair has both.
  StereoRectifier(const CameraIntrinsics& left, const CameraIntrinsics& right,
                  const SE3& T_left_right);
  ~StereoRectifier();

  const RectifiedCamera& camera() const { return camera_; }
  /// The rectified camera's frame into the left camera's.
  const SE3& T_left_rectified() const { return T_left_rectified_; }

  /// Pixels that the camera does not see are 0. Throws InputError where the image is not of the
  /// camera's size.
  Image Left(const Image& image) const;
  Image Right(const Image& image) const;
  /// 255 where the left camera sees and its own `mask` (as large as its images; null: none) lets
  /// keypoints be, else 0. Edges are kept away from by a few pixels.
  Image LeftMask(const Image* mask) const;
  Image RightMask() const;

 private:
  struct Maps;
  RectifiedCamera camera_;
  SE3 T_left_rectified_;
  std::unique_ptr<Maps> left_;
  std::unique_ptr<Maps> right_;
};

}  // namespace regolith
