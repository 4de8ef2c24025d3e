// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/stereo/landmark_aligner.h"
#include "regolith/stereo/landmark_search.h"
#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// A pair of images and what is known of it.
struct StereoFrame {
  TimeNs stamp = 0;
  StereoFeatures features;
  SE3 T_world_camera;
  std::vector<LandmarkId> landmarks;  ///< one a feature; kNoId: none
};

/// How a frame stands in the map.
struct TrackingResult {
  KeyframeId reference = kNoId;  ///< the keyframe that sees most of the same
  int inliers = 0;               ///< landmarks that agree with the pose
  int outliers = 0;
  int close_tracked = 0;  ///< close features with a landmark …
  int close_free = 0;     ///< … and without
};

/// Finds the landmarks of the map in a frame, and with them its pose (Mur-Artal et al. 2015,
/// section V). A step that fails leaves the frame as it was.
class FrameTracker {
 public:
  FrameTracker(const StereoOptions& options, StereoMap* map);

  /// From a predicted pose (in `frame`): what the last frame saw is looked for around its predicted
  /// place, close points that are no landmarks too.
  bool FollowFrame(const StereoFrame& last, StereoFrame* frame);
  /// Without a prediction: a keyframe's landmarks by descriptors alone.
  bool FollowKeyframe(KeyframeId keyframe, StereoFrame* frame);
  /// From about the right pose: all landmarks around, the whole of what is seen. Nothing where
  /// fewer than `min_inliers` agree.
  std::optional<TrackingResult> FollowMap(double radius, int min_inliers, StereoFrame* frame);

 private:
  bool SearchAround(const StereoFrame& last, double radius, StereoFrame* frame);
  /// Keyframes that stood near and looked the same way.
  void AddNear(const SE3& T_world_camera, std::vector<KeyframeId>* keyframes) const;
  std::vector<LandmarkId> LocalLandmarks(const StereoFrame& frame) const;
  void AddLandmarks(double radius, StereoFrame* frame);
  void AlignKeypoints(StereoFrame* frame) const;
  TrackingResult Judge(StereoFrame* frame);

  StereoOptions options_;
  StereoMap* map_;
  LandmarkSearch search_;
  LandmarkAligner aligner_;
  SightingNoise detected_;  ///< of places that are not aligned yet
  double close_depth_;      ///< m
};

}  // namespace regolith
