// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/features/outlier_rejection.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/image.h"

namespace regolith {

/// A place in an image and its bearing.
struct Sighting {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
};

/// What tracking knows of its camera, which may be nothing.
class TrackGeometry {
 public:
  /// `camera` may be null and must outlive this.
  explicit TrackGeometry(const CameraModel* camera) : camera_(camera) {}

  bool has_camera() const { return camera_ != nullptr; }
  /// Pixels, mean of both axes; 0 without a camera.
  double focal() const;

  /// Throws InputError where the image is not as large as the camera's, or not as large as its
  /// pixels.
  void CheckImage(const Image& image) const;

  /// Unit bearing (camera frame); (0, 0, 1) without a camera; nothing where its lens has none.
  std::optional<Eigen::Vector3d> Bearing(const Eigen::Vector2f& pixel) const;

  /// Where a pixel goes by the camera's rotation alone. It stays where no rotation or camera is
  /// given, or where it leaves what the lens can see.
  Eigen::Vector2f Rotated(const Eigen::Vector2f& pixel, const Eigen::Vector3d& bearing,
                          const std::optional<Eigen::Quaterniond>& R_current_previous) const;

  /// Adds a row; its bearings only where there is a camera.
  void Append(const Sighting& first, const Sighting& second, Correspondences* matches) const;

 private:
  const CameraModel* camera_;
};

}  // namespace regolith
