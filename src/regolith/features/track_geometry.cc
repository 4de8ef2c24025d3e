// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/track_geometry.h"

#include "regolith/core/check.h"
#include "regolith/core/error.h"

namespace regolith {

double TrackGeometry::focal() const {
  return camera_ == nullptr ? 0.0 : camera_->intrinsics().focal.mean();
}

void TrackGeometry::CheckImage(const Image& image) const {
  const auto pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  if (image.width < 0 || image.height < 0 || image.data.size() != pixels) {
    throw InputError("image", Concatenate(image.width, " × ", image.height, ", but ",
                                          image.data.size(), " pixels"));
  }
  if (camera_ == nullptr) return;
  const CameraIntrinsics& intrinsics = camera_->intrinsics();
  if (image.width == intrinsics.width && image.height == intrinsics.height) return;
  throw InputError("image", Concatenate(image.width, " × ", image.height,
                                        " pixels; the camera's intrinsics are of ",
                                        intrinsics.width, " × ", intrinsics.height));
}

std::optional<Eigen::Vector3d> TrackGeometry::Bearing(const Eigen::Vector2f& pixel) const {
  if (camera_ == nullptr) return Eigen::Vector3d::UnitZ();
  return camera_->Unproject(pixel.cast<double>());
}

Eigen::Vector2f TrackGeometry::Rotated(
    const Eigen::Vector2f& pixel, const Eigen::Vector3d& bearing,
    const std::optional<Eigen::Quaterniond>& R_current_previous) const {
  if (camera_ == nullptr || !R_current_previous) return pixel;
  const std::optional<Eigen::Vector2d> rotated = camera_->Project(*R_current_previous * bearing);
  return rotated ? rotated->cast<float>().eval() : pixel;
}

void TrackGeometry::Append(const Sighting& first, const Sighting& second,
                           Correspondences* matches) const {
  matches->first.push_back(first.pixel);
  matches->second.push_back(second.pixel);
  if (!has_camera()) return;
  matches->first_bearings.push_back(first.bearing);
  matches->second_bearings.push_back(second.bearing);
}

}  // namespace regolith
