// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regolith/features/stereo_matcher.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/system/frame_report.h"
#include "regolith/system/image_tracker.h"
#include "regolith/system/lidar_distances.h"
#include "regolith/system/pipeline_options.h"
#include "regolith/vio/visual_inertial_odometry.h"

namespace regolith {

/// What the camera's side of a pipeline is there for.
enum class VisualRole {
  kTracks,  ///< features alone, no odometry
  kHelps,   ///< odometry beside the lidar's
  kLeads,   ///< its odometry is the pipeline's
};

/// The features of an image, as tracked.
struct ImageTracks {
  TimeNs stamp = 0;
  std::vector<TrackedFeature> features;
};

/// The camera's side of a pipeline: tracks, pairs of images, visual–inertial odometry.
class VisualPart {
 public:
  /// The tracked camera is in the rig; with odometry an IMU too, and with vio.stereo a right eye
  /// apart from the left. `camera_mask` as ImageTracker has it.
  VisualPart(const PipelineOptions& options, const RigCalibration& rig, VisualRole role,
             std::optional<Image> camera_mask);

  /// What the lidar's side has found, before a measurement at a later time.
  void AddScanEstimate(const ScanEstimate& estimate);
  std::vector<FrameReport> Process(const SensorEvent& event);
  std::vector<FrameReport> Finish();

  /// For the lidar's side, since the last call.
  std::vector<BodyVelocity> TakeVelocities() { return std::exchange(velocities_, {}); }

  /// Poses as first put out, where it leads: at scans where there are any, else at images.
  const Trajectory& trajectory() const { return trajectory_; }
  /// The same as known now.
  Trajectory Refined() const;
  /// The newest state, while there is one.
  std::optional<InertialState> Newest() const;
  /// Of the last image.
  const ImageTracks& tracks() const { return tracks_; }
  size_t images() const { return images_; }
  size_t scans() const { return scans_; }
  size_t resets() const { return odometry_ ? odometry_->resets() : 0; }
  size_t keyframes() const { return odometry_ ? odometry_->keyframes() : 0; }
  std::vector<std::string> Notices() const;

 private:
  /// What a pose goes with: a frame of the window's history.
  struct Anchor {
    size_t frame = 0;
    SE3 T_frame_body;
  };

  std::vector<FrameReport> TrackPair(const CameraFrame& frame);
  std::vector<FrameReport> Track(const CameraFrame& frame);
  std::vector<FrameReport> Report(std::vector<VioEstimate> estimates);
  void KeepPoses(const std::vector<VioEstimate>& estimates);
  void TellVelocity(const VioEstimate& estimate);

  VisualRole role_;
  ImageTracker tracker_;
  std::unique_ptr<VisualInertialOdometry> odometry_;  ///< null where features alone are wanted
  std::unique_ptr<LidarDistances> distances_;         ///< where it helps a lidar
  std::unique_ptr<StereoMatcher> stereo_;             ///< null with one camera
  double velocity_sigma_;
  std::string right_camera_;
  std::optional<CameraFrame> waiting_left_;   ///< for its right one
  std::optional<CameraFrame> waiting_right_;  ///< for its left one
  std::deque<FrameReport> tracked_;           ///< images that wait for their estimate
  std::vector<BodyVelocity> velocities_;
  Trajectory trajectory_;
  std::vector<Anchor> anchors_;  ///< of the poses of `trajectory_`
  ImageTracks tracks_;
  size_t images_ = 0;
  size_t scans_ = 0;
  size_t pairs_missed_ = 0;
  size_t pairs_seen_ = 0;
  size_t pairs_unmatched_ = 0;
};

/// The other eye of the tracked camera. Throws InputError where there is none, or too near.
std::string RightCamera(const PipelineOptions& options, const RigCalibration& rig);

}  // namespace regolith
