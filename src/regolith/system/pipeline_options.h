// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "regolith/backend/backend_options.h"
#include "regolith/backend/visual_places.h"
#include "regolith/features/feature_options.h"
#include "regolith/features/model_manifest.h"
#include "regolith/lio/lego_loam_options.h"
#include "regolith/lio/lidar_odometry_options.h"
#include "regolith/stereo/stereo_options.h"
#include "regolith/system/map_builder.h"
#include "regolith/system/supervisor.h"
#include "regolith/system/visual_loop_options.h"
#include "regolith/vio/lidar_depth_options.h"
#include "regolith/vio/vio_options.h"

namespace regolith {

/// What makes a pose of each scan, or, without a lidar, of each image.
enum class OdometryKind {
  kLio,       ///< LidarOdometry
  kLegoLoam,  ///< LegoLoam
  kVio,       ///< VisualInertialOdometry: no lidar
  kStereo,    ///< StereoPipeline: two cameras and nothing else
};

/// One pipeline: which subsystems run, and how.
struct PipelineOptions {
  std::string name;
  std::string tracked_camera;  ///< name in the rig of the one whose images are tracked; empty: none
  FeatureOptions features;
  OdometryKind odometry = OdometryKind::kLio;
  LidarOdometryOptions lio;
  LegoLoamOptions lego_loam;
  /// Visual–inertial odometry beside the lidar's (kLio): each helps the other.
  bool visual = false;
  VioOptions vio;
  LidarDepthOptions lidar_depth;
  /// m/s, 1 σ of a velocity that visual odometry tells the lidar's; 0: it does not tell.
  double visual_velocity_sigma = 0.05;
  StereoOptions stereo;
  VisualPlacesOptions places;      ///< loops that images propose, or confirm (kStereo)
  VisualLoopOptions visual_loops;  ///< of a camera beside a lidar (kLio)
  /// s after which the camera's side sees what the lidar's found (kLio): so far the one may be
  /// ahead of the other, and so much later the results come at most.
  double feedback_delay = 0.3;
  /// s without scans, after which poses are made of what IMU, wheels and camera tell.
  double lidar_silence = 0.5;
  SupervisorOptions supervisor;
  BackendOptions backend;  ///< of an odometry that has none of its own
  MapBuilderOptions map;

  /// Of the network that `features` names, where it names one. No setting: the program finds it.
  std::optional<ModelManifest> feature_model;

  /// Throws CheckError on values that make no pipeline.
  void Check() const;
};

}  // namespace regolith
