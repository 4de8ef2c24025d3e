// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "regolith/features/feature_frontend.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/system/gyro_rotation.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// Follows the features of one camera of a rig; the gyro says how the camera turned between its
/// images.
class ImageTracker {
 public:
  /// The camera `options.tracked_camera` must be in the rig. `mask`, where given, is as large as
  /// its images and 0 where the rover sees itself. Throws InputError where the network's file is
  /// not what its manifest says.
  ImageTracker(const PipelineOptions& options, const RigCalibration& rig,
               std::optional<Image> mask);

  const std::string& camera() const { return name_; }

  void AddImu(const ImuSample& sample) { gyro_.Add(sample); }
  void SetGyroBias(const Eigen::Vector3d& gyro_bias) { gyro_.SetBias(gyro_bias); }

  /// Images in order of their stamps, after the IMU samples of their time.
  TrackedFrame Track(TimeNs time, const Image& image);

 private:
  std::string name_;
  SE3 T_imu_camera_;
  std::optional<Image> mask_;
  std::unique_ptr<CameraModel> model_;
  std::unique_ptr<FeatureFrontend> frontend_;
  GyroRotation gyro_;
  std::optional<TimeNs> last_time_;
};

}  // namespace regolith
