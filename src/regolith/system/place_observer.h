// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "regolith/backend/visual_places.h"
#include "regolith/features/feature_extractor.h"
#include "regolith/sensor/camera_model.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/system/keyframe_sight.h"
#include "regolith/system/pipeline_options.h"
#include "regolith/vio/lidar_depth.h"

namespace regolith {

/// Makes of an image what a place is found again by: ORB features, whatever the frontend of the
/// pipeline follows, with distances from the lidar's returns.
class PlaceObserver {
 public:
  /// The rig has a lidar and the camera `options.tracked_camera`; `mask` as ImageTracker has it.
  PlaceObserver(const PipelineOptions& options, const RigCalibration& rig,
                std::optional<Image> mask);

  /// In the order of the keyframes. `T_odom_body` is the keyframe's. Without a global descriptor.
  PlaceView Observe(const KeyframeSight& sight, const SE3& T_odom_body);

 private:
  SE3 T_imu_camera_;
  SE3 T_imu_lidar_;
  std::optional<Image> mask_;
  int max_keypoints_;
  std::unique_ptr<CameraModel> camera_;
  std::unique_ptr<FeatureExtractor> extractor_;
  LidarDepth depth_;  ///< in the odometry's world
};

}  // namespace regolith
