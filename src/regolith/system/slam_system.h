// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/lidar_odometry.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/system/map_builder.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// Which measurements a pipeline reads.
struct SensorNeeds {
  bool imu = false;
  bool lidar = false;
};

/// What the system says of one frame; with a lidar a frame is a scan.
struct FrameReport {
  TimeNs stamp = 0;
  SE3 T_world_body;  ///< as known when the frame had been worked off
  std::string leader;
  bool at_rest = false;
  int points = 0;
  int matches = 0;
  double inliers = 0.0;
  double residual_scale = 0.0;  ///< m
  int degenerate_directions = 0;
  Matrix6d covariance = Matrix6d::Zero();  ///< [rotation (right, rad), position (m)]
  std::vector<StageTime> stages;
};

/// A whole pipeline: takes measurements in order of their stamps and makes a trajectory and a map
/// of them. The same code serves recordings and live sensors, and it never waits for a clock.
class SlamSystem {
 public:
  /// Throws InputError where the rig lacks a sensor that the pipeline cannot do without.
  SlamSystem(const PipelineOptions& options, const RigCalibration& rig, ThreadPool* threads);

  SensorNeeds needs() const { return needs_; }

  /// The frames that this measurement completed, mostly none.
  std::vector<FrameReport> Process(const SensorEvent& event);
  /// The frames that still waited for measurements.
  std::vector<FrameReport> Finish();

  /// Poses of the body as first put out, at each frame's stamp.
  const Trajectory& odometry() const { return odometry_; }
  /// The best poses known now.
  const Trajectory& trajectory() const { return odometry_; }
  const std::vector<MapPoint>& map_points() const { return map_.points(); }

  size_t scans_seen() const { return scans_seen_; }
  std::vector<std::string> Notices() const { return lio_.Notices(); }

 private:
  std::vector<FrameReport> Report(std::vector<ScanEstimate> estimates);

  SensorNeeds needs_;
  LidarOdometry lio_;
  MapBuilder map_;
  Trajectory odometry_;
  size_t scans_seen_ = 0;
};

}  // namespace regolith
