// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/system/image_tracker.h"

#include "regolith/core/check.h"

namespace regolith {
namespace {

const CameraCalibration& CameraOf(const PipelineOptions& options, const RigCalibration& rig) {
  const auto camera = rig.cameras.find(options.tracked_camera);
  REGOLITH_CHECK(camera != rig.cameras.end(), "camera ", options.tracked_camera);
  return camera->second;
}

}  // namespace

ImageTracker::ImageTracker(const PipelineOptions& options, const RigCalibration& rig,
                           std::optional<Image> mask)
    : name_(options.tracked_camera),
      T_imu_camera_(CameraOf(options, rig).T_imu_camera),
      mask_(std::move(mask)),
      model_(CameraModel::Create(CameraOf(options, rig).intrinsics)),
      frontend_(FeatureFrontend::Create(options.features, model_.get(), options.feature_model)) {
  const CameraIntrinsics& intrinsics = model_->intrinsics();
  REGOLITH_CHECK(!mask_ || (mask_->width == intrinsics.width && mask_->height == intrinsics.height),
                 "mask of ", mask_->width, " × ", mask_->height);
}

TrackedFrame ImageTracker::Track(TimeNs time, const Image& image) {
  FrontendInput input;
  input.time = time;
  input.image = &image;
  input.mask = mask_ ? &*mask_ : nullptr;
  if (last_time_) {
    if (const auto R_previous_current_imu = gyro_.Between(*last_time_, time)) {
      const Eigen::Quaterniond& R_imu_camera = T_imu_camera_.rotation;
      input.R_previous_current = R_imu_camera.conjugate() * *R_previous_current_imu * R_imu_camera;
    }
  }
  last_time_ = time;
  return frontend_->Track(input);
}

}  // namespace regolith
