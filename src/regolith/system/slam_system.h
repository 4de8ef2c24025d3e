// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/core/thread_pool.h"
#include "regolith/features/stereo_matcher.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/system/image_tracker.h"
#include "regolith/system/lidar_distances.h"
#include "regolith/system/map_builder.h"
#include "regolith/system/pipeline_options.h"
#include "regolith/vio/visual_inertial_odometry.h"

namespace regolith {

/// Which measurements a pipeline reads.
struct SensorNeeds {
  bool imu = false;
  bool lidar = false;
  bool wheels = false;
  std::vector<std::string> cameras;  ///< names in the rig
};

enum class FrameSource { kScan, kImage };

/// What the system says of one scan or image.
struct FrameReport {
  FrameSource source = FrameSource::kScan;
  TimeNs stamp = 0;
  std::vector<StageTime> stages;

  // Of a scan.
  SE3 T_world_body;    ///< as known when the frame had been worked off
  std::string leader;  ///< of an image "camera"
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

  FrontendStatus features;            ///< of an image
  std::optional<VioEstimate> visual;  ///< of an image that visual–inertial odometry has worked off
};

/// Whether a pipeline tracks images of this rig: it names a camera that is there.
bool TracksImages(const PipelineOptions& options, const RigCalibration& rig);

/// What a pipeline reads of this rig. Throws InputError as SlamSystem does.
SensorNeeds NeedsOf(const PipelineOptions& options, const RigCalibration& rig);

/// The features of an image, as tracked.
struct ImageTracks {
  TimeNs stamp = 0;
  std::vector<TrackedFeature> features;
};

/// A whole pipeline: takes measurements in order of their stamps and makes a trajectory and a map
/// of them. The same code serves recordings and live sensors, and it never waits for a clock.
class SlamSystem {
 public:
  /// Throws InputError where the rig lacks a sensor that the pipeline cannot do without. A camera
  /// is none of those. `camera_mask` belongs to the tracked camera (ImageTracker).
  SlamSystem(const PipelineOptions& options, const RigCalibration& rig, ThreadPool* threads,
             std::optional<Image> camera_mask = std::nullopt);

  const SensorNeeds& needs() const { return needs_; }

  /// The frames that this measurement completed, mostly none.
  std::vector<FrameReport> Process(const SensorEvent& event);
  /// The frames that still waited for measurements.
  std::vector<FrameReport> Finish();

  /// Poses of the body as first put out, at each frame's stamp.
  const Trajectory& odometry() const { return odometry_; }
  /// The best poses known now.
  Trajectory trajectory() const;
  /// The map as it lies with the best poses known now.
  std::vector<MapPoint> MapPoints() const;

  size_t scans_seen() const { return scans_seen_; }
  size_t images_seen() const { return images_seen_; }
  /// Stamps at which a pose is expected: scans, or images where no scan came.
  size_t stamps_seen() const { return scans_seen_ > 0 ? scans_seen_ : images_seen_; }
  /// New starts of an odometry that had lost its way.
  size_t resets() const { return visual_ ? visual_->resets() : 0; }
  KeyframeCounts keyframe_counts() const;
  /// Of the last image that was tracked, to be shown.
  const ImageTracks& tracks() const { return tracks_; }
  /// Keyframes and loops; null where the pipeline has no back end, or one inside its odometry.
  const Backend* backend() const { return backend_.get(); }
  std::vector<std::string> Notices() const;

 private:
  std::vector<FrameReport> Report(std::vector<ScanEstimate> estimates);
  std::vector<FrameReport> Report(std::vector<VioEstimate> estimates);
  std::vector<FrameReport> Track(const CameraFrame& frame);
  std::vector<FrameReport> TrackPair(const CameraFrame& frame);
  std::vector<StageTime> AddKeyframe(const ScanEstimate& estimate);
  void TellScan(const ScanEstimate& estimate);
  void TellVelocity(const VioEstimate& estimate);
  void KeepVisualPoses(const std::vector<VioEstimate>& estimates);

  /// What a pose of visual odometry goes with: a frame of its window's history.
  struct VisualAnchor {
    size_t frame = 0;
    SE3 T_frame_body;
  };

  SensorNeeds needs_;
  std::unique_ptr<ScanOdometry> scan_odometry_;     ///< null without a lidar's part
  std::unique_ptr<Backend> backend_;                ///< null where there is none
  std::unique_ptr<VisualInertialOdometry> visual_;  ///< null without a camera's part
  std::unique_ptr<LidarDistances> distances_;       ///< where both are
  double visual_velocity_sigma_;
  std::vector<VisualAnchor> anchors_;      ///< of the poses of `odometry_`
  std::deque<FrameReport> tracked_;        ///< images that wait for their estimate
  std::unique_ptr<StereoMatcher> stereo_;  ///< null with one camera
  std::string right_camera_;
  std::optional<CameraFrame> waiting_left_;   ///< for its right one
  std::optional<CameraFrame> waiting_right_;  ///< for its left one
  size_t pairs_missed_ = 0;
  std::unique_ptr<ImageTracker> tracker_;  ///< null where no images are tracked
  ImageTracks tracks_;
  MapBuilder map_;
  Trajectory odometry_;
  size_t scans_seen_ = 0;
  size_t images_seen_ = 0;
};

}  // namespace regolith
