// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "regolith/core/stopwatch.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/geometry/se3.h"
#include "regolith/system/supervisor.h"
#include "regolith/vio/visual_inertial_odometry.h"

namespace regolith {

enum class FrameSource { kScan, kImage };

/// What the system says of one scan or image.
struct FrameReport {
  FrameSource source = FrameSource::kScan;
  TimeNs stamp = 0;
  TimeNs end = 0;  ///< of the scan's last point, of the image
  std::vector<StageTime> stages;
  std::chrono::steady_clock::time_point completed;  ///< when its pose was known

  /// Which subsystem led then, by the supervisor's rules, and how each did.
  std::optional<Subsystem> led_by;
  std::array<SubsystemState, kSubsystems> states = {};

  // Of a scan.
  bool has_scan = true;  ///< false: a pose in a time without scans
  SE3 T_world_body;      ///< as known when the frame had been worked off
  std::string leader;    ///< what the pose is made of; of an image "camera"
  bool at_rest = false;
  int points = 0;
  int matches = 0;
  double inliers = 0.0;
  double residual_scale = 0.0;    ///< m
  int degenerate_directions = 0;  ///< of six, that the scan says nothing of
  /// Information over noise where that is least, and the direction (unit, world): ObservableSystem.
  double weakest_ratio = 0.0;
  Eigen::Vector3d weakest_position = Eigen::Vector3d::Zero();
  Matrix6d covariance = Matrix6d::Zero();  ///< [rotation (right, rad), position (m)]
  std::optional<size_t> keyframe;          ///< its number in the back end, where it became one

  FrontendStatus features;            ///< of an image
  std::optional<VioEstimate> visual;  ///< of an image that visual–inertial odometry has worked off
};

}  // namespace regolith
