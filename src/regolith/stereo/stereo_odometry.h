// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/stopwatch.h"
#include "regolith/features/place_index.h"
#include "regolith/stereo/frame_tracker.h"
#include "regolith/stereo/local_mapper.h"
#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// How stereo odometry does.
enum class StereoHealth {
  kGood,
  kNotStarted,   ///< too few keypoints with a distance for a first map
  kLost,         ///< nothing is said of where the camera is
  kRelocalised,  ///< found its way again in this image
  kNoPair,       ///< the right image did not come
};
const char* StereoHealthName(StereoHealth health);

/// What odometry says of one pair of images.
struct StereoEstimate {
  TimeNs stamp = 0;
  StereoHealth health = StereoHealth::kNotStarted;
  std::optional<SE3> T_world_camera;  ///< as known now; nothing where it is not
  size_t frame = 0;                   ///< its number in the history, where it has a pose
  bool is_keyframe = false;
  TrackingResult tracking;
  std::vector<StageTime> stages;
};

/// What a keyframe looks like, for loops: once its pose has settled.
struct StereoPlace {
  KeyframeId keyframe = kNoId;
  TimeNs stamp = 0;
  SE3 T_world_camera;
  Eigen::VectorXf global;
  Descriptors descriptors;
  std::vector<Eigen::Vector3d> bearings;  ///< unit, camera frame, one a descriptor
  std::vector<double> ranges;             ///< m along the bearing; 0: unknown
};

/// Stereo odometry with a local map, after ORB-SLAM2 (Mur-Artal & Tardós 2017) without its loops:
/// tracking by projection, keyframes, local bundle adjustment, and relocalisation in its own map
/// once it is lost. All of it one after the other, so that a run is the same every time. Frames are
/// those of the rectified left camera.
class StereoOdometry {
 public:
  /// `T_world_camera` of the first pair that makes a map.
  StereoOdometry(const StereoOptions& options, const RectifiedCamera& camera,
                 const SE3& T_world_camera);

  /// Pairs in order of their stamps.
  StereoEstimate Process(TimeNs stamp, StereoFeatures features);

  /// T_world_camera of a frame of the history, with all that is known now.
  SE3 Refined(size_t frame) const;
  /// The keyframes that have settled since the last call; all of them at the end.
  std::vector<StereoPlace> TakePlaces(bool all);

  const StereoMap& map() const { return map_; }
  size_t keyframes_made() const { return keyframes_made_; }
  size_t losses() const { return losses_; }

 private:
  enum class State { kNotStarted, kTracking, kLost };
  struct FramePose {
    KeyframeId reference = kNoId;
    SE3 T_reference_camera;
  };

  bool Start(StereoFrame* frame);
  std::optional<TrackingResult> Track(StereoFrame* frame);
  std::optional<TrackingResult> Relocalise(StereoFrame* frame);
  SE3 Predicted(TimeNs stamp) const;
  bool WantsKeyframe(const TrackingResult& tracking, const StereoFrame& frame) const;
  void InsertKeyframe(KeyframeId reference, StereoFrame* frame);
  void Keep(const StereoFrame& frame, KeyframeId reference, StereoEstimate* estimate);
  StereoPlace PlaceOf(const StereoKeyframe& keyframe) const;

  StereoOptions options_;
  SE3 T_world_start_;
  StereoMap map_;
  FrameTracker tracker_;
  LocalMapper mapper_;
  PlaceIndex places_;
  State state_ = State::kNotStarted;
  StereoFrame last_;
  std::optional<StereoFrame> before_last_;  ///< pose and stamp alone, where both were tracked
  KeyframeId reference_ = kNoId;
  std::optional<TimeNs> relocalised_;
  std::vector<FramePose> history_;
  std::deque<KeyframeId> unsettled_;
  size_t keyframes_made_ = 0;
  size_t losses_ = 0;
};

}  // namespace regolith
