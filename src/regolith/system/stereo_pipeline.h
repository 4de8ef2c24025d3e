// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regolith/backend/backend.h"
#include "regolith/backend/keyframe_selector.h"
#include "regolith/backend/visual_places.h"
#include "regolith/cloud/map_point.h"
#include "regolith/core/thread_pool.h"
#include "regolith/features/feature_frontend.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/lio/scan_odometry.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/stereo/stereo_frontend.h"
#include "regolith/stereo/stereo_odometry.h"
#include "regolith/system/pipeline_options.h"

namespace regolith {

/// What the stereo pipeline says of one image of the left camera.
struct StereoReport {
  StereoEstimate estimate;
  SE3 T_world_body;  ///< where the estimate has a pose
  FrontendStatus features;
  std::vector<StageTime> stages;
};

/// Stereo SLAM: brings the images of both eyes together, follows them (StereoOdometry), gives poses
/// at the stamps that are wanted, and closes loops by what the keyframes saw (VisualPlaces,
/// Backend). Where it is lost it says nothing.
class StereoPipeline {
 public:
  /// The cameras `left` and `right` are in the rig and apart (RightCamera). `mask`: of the left
  /// one.
  StereoPipeline(const PipelineOptions& options, const RigCalibration& rig,
                 const std::string& right_camera, const std::optional<Image>& mask,
                 ThreadPool* threads);

  /// An eye waits for the other; a left image whose right one does not come is reported without a
  /// pose.
  std::vector<StereoReport> AddImage(const CameraFrame& frame);
  /// Asks for a pose at a scan's time. Times in their order.
  void AddStamp(TimeNs time);
  std::vector<StereoReport> Finish();

  /// Poses of the body as first put out: at the scans, or at the images where no scan came.
  const Trajectory& odometry() const { return Wanted().poses; }
  /// The same with all that is known now: keyframes after their adjustment, and loops.
  Trajectory Refined() const;
  /// Landmarks, where they are known to be now.
  std::vector<MapPoint> MapPoints() const;
  KeyframeCounts Counts() const;
  /// Null where loops are not closed.
  const Backend* backend() const { return backend_.get(); }
  size_t images_seen() const { return images_seen_; }
  std::vector<std::string> Notices() const;

 private:
  /// A pose between two frames of the odometry's history.
  struct Anchor {
    size_t before = 0;
    size_t after = 0;
    double share = 1.0;  ///< of the way to the later one
  };
  struct AnchoredPoses {
    Trajectory poses;
    std::vector<Anchor> anchors;
  };

  const AnchoredPoses& Wanted() const { return has_stamps_ ? at_scans_ : at_images_; }
  StereoReport Process(const CameraFrame& left, const CameraFrame& right);
  StereoReport Unpaired(const CameraFrame& left);
  void AnswerStamps(const StereoEstimate& estimate);
  void CloseLoops(bool all);
  void AddPlace(StereoPlace place);
  SE3 BodyPose(const SE3& T_world_camera) const {
    return T_world_camera * T_body_camera_.Inverse();
  }

  std::string left_camera_;
  std::string right_camera_;
  double max_gap_;  ///< s between two images that poses are interpolated over
  StereoFrontend frontend_;
  SE3 T_body_camera_;  ///< of the rectified left camera
  StereoOdometry odometry_;
  StereoOptions options_;
  std::unique_ptr<Backend> backend_;
  KeyframeSelector selector_;
  std::unique_ptr<VisualPlaces> places_;
  UncertainPose drift_;  ///< T_odom_body of the back end's last keyframe
  std::optional<CameraFrame> waiting_left_;
  std::optional<CameraFrame> waiting_right_;
  std::deque<TimeNs> stamps_;  ///< asked for, not answered yet
  bool has_stamps_ = false;
  std::optional<StereoEstimate> last_;
  AnchoredPoses at_scans_;
  AnchoredPoses at_images_;
  size_t images_seen_ = 0;
  size_t pairs_missed_ = 0;
  size_t pairs_lost_ = 0;
  size_t pairs_before_start_ = 0;
};

}  // namespace regolith
