// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regolith/core/serial_worker.h"
#include "regolith/core/thread_pool.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"
#include "regolith/system/backend_part.h"
#include "regolith/system/frame_report.h"
#include "regolith/system/lidar_part.h"
#include "regolith/system/live_state.h"
#include "regolith/system/pipeline_options.h"
#include "regolith/system/stereo_pipeline.h"
#include "regolith/system/supervisor.h"
#include "regolith/system/visual_part.h"

namespace regolith {

/// Which measurements a pipeline reads.
struct SensorNeeds {
  bool imu = false;
  bool lidar = false;
  bool wheels = false;
  std::vector<std::string> cameras;  ///< names in the rig
  // A recording that lacks them is served by the others.
  bool may_lack_cameras = false;
  bool may_lack_wheels = false;
};

/// Whether a pipeline tracks images of this rig: it names a camera that is there.
bool TracksImages(const PipelineOptions& options, const RigCalibration& rig);

/// What a pipeline reads of this rig. Throws InputError as SlamSystem does.
SensorNeeds SensorsNeeded(const PipelineOptions& options, const RigCalibration& rig);

/// A whole pipeline: takes measurements in order of their stamps and makes a trajectory and a map
/// of them. The same code serves recordings and live sensors, and it never waits for a clock.
///
/// The camera's side, the lidar's and the back end each work on a thread of their own where there
/// are threads. What they tell each other goes by the order of the measurements: the lidar's side
/// takes a measurement after the camera's has, and the camera's sees what the lidar's has found
/// `feedback_delay` later. So results do not depend on threads, nor on how fast they are.
class SlamSystem {
 public:
  /// A rig that lacks a sensor is served by the others, as far as the pipeline can do without it;
  /// else throws InputError. `camera_mask` belongs to the tracked camera (ImageTracker).
  SlamSystem(const PipelineOptions& options, const RigCalibration& rig, ThreadPool* threads,
             std::optional<Image> camera_mask = std::nullopt);
  ~SlamSystem();

  const SensorNeeds& needs() const { return needs_; }

  /// Takes a measurement; gives the frames that are completed, in an order of their own stamps and
  /// sources that is the same on every run. Throws what went wrong with an earlier one, too.
  std::vector<FrameReport> Process(SensorEvent event);
  /// Waits until all that was given is worked off. Does not throw.
  std::vector<FrameReport> Settle();
  /// The same, with frames that still waited for measurements.
  std::vector<FrameReport> Finish();

  /// The state at the newest IMU sample, smooth through corrections, in the frame `odom`. Nothing
  /// before the first pose, nor without an IMU. For live use: it depends on how fast the computer
  /// is.
  std::optional<NavState> live() const { return live_.state(); }
  /// Where `odom` lies in the map that loops have corrected.
  SE3 T_map_odom() const { return backend_ ? backend_->T_map_odom() : SE3(); }
  /// Of the last image that has been tracked, to be shown. For live use, likewise.
  ImageTracks tracks() const;

  // What follows is for after Settle or Finish, until the next measurement.

  /// Poses of the body as first put out, at each frame's stamp.
  const Trajectory& odometry() const;
  /// The best poses known now.
  Trajectory trajectory() const;
  /// The map as it lies with the best poses known now.
  std::vector<MapPoint> MapPoints() const;
  size_t scans_seen() const { return scans_seen_; }
  size_t images_seen() const;
  /// Stamps at which a pose is expected: scans (and in a time without them, moments at their
  /// rate), or images where no scan came.
  size_t stamps_seen() const;
  /// New starts of the odometry that the trajectory is made of, had it lost its way.
  size_t resets() const { return lidar_ ? 0 : visual_restarts(); }
  /// The same of visual odometry, whether it leads or helps.
  size_t visual_restarts() const { return visual_ ? visual_->resets() : 0; }
  KeyframeCounts keyframe_counts() const;
  /// Keyframes and loops; null where the pipeline has no back end, or one inside its odometry.
  const Backend* backend() const;
  std::vector<std::string> Notices() const;

 private:
  template <typename Value>
  using Numbered = std::deque<std::pair<size_t, Value>>;  ///< by the measurement it came of

  std::vector<FrameReport> ProcessStereo(const SensorEvent& event);
  std::vector<FrameReport> Report(std::vector<StereoReport> pairs);
  void PostVisual(size_t number, size_t known, std::shared_ptr<const SensorEvent> event);
  void PostLidar(size_t number, std::shared_ptr<const SensorEvent> event);
  size_t OlderThanFeedback(TimeNs time);
  void FollowLive(const SensorEvent& event);
  std::vector<FrameReport> Collect();
  void Supervise(size_t number, FrameReport* report);
  void ObserveSensors(size_t number);
  void RethrowFailure() const;

  std::vector<std::string> setup_notices_;  ///< what the rig lacks of what the options ask for
  PipelineOptions options_;                 ///< as this rig can serve them
  SensorNeeds needs_;
  std::unique_ptr<StereoPipeline> stereo_;  ///< alone where it is there
  std::unique_ptr<VisualPart> visual_;      ///< null without a camera
  std::unique_ptr<LidarPart> lidar_;        ///< null where the camera's side leads
  std::unique_ptr<BackendPart> backend_;    ///< null where there is none

  mutable std::mutex exchange_;  ///< guards what the sides leave for each other and for the caller
  Numbered<std::vector<BodyVelocity>> velocities_;
  Numbered<std::shared_ptr<const ScanEstimate>> estimates_;
  Numbered<FrameReport> visual_reports_;
  Numbered<FrameReport> lidar_reports_;
  std::optional<InertialState> newest_;  ///< that `live_` has not taken yet
  ImageTracks tracks_;

  // The caller's own.
  size_t count_ = 0;                ///< measurements so far
  std::deque<TimeNs> young_times_;  ///< of measurements younger than the feedback
  size_t scans_seen_ = 0;
  LiveState live_;
  Supervisor supervisor_;
  Numbered<std::pair<Subsystem, TimeNs>> sensor_times_;  ///< that the supervisor has not seen yet
  std::array<TimeNs, kSubsystems> observed_ = {};
  std::array<double, kSubsystems + 1> led_seconds_ = {};  ///< the last: nobody
  std::optional<TimeNs> supervised_;

  SerialWorker visual_worker_;
  SerialWorker lidar_worker_;
};

}  // namespace regolith
