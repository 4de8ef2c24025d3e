// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "regolith/stereo/frame_tracker.h"
#include "regolith/stereo/landmark_aligner.h"
#include "regolith/stereo/landmark_search.h"
#include "regolith/stereo/stereo_map.h"
#include "regolith/stereo/stereo_options.h"

namespace regolith {

/// Makes keyframes of frames and keeps the map around them in order (Mur-Artal et al. 2015, section
/// VI; Mur-Artal & Tardós 2017, sections III-C and III-E).
class LocalMapper {
 public:
  LocalMapper(const StereoOptions& options, StereoMap* map);

  /// Makes a keyframe of the frame, new landmarks of what it alone sees, and adjusts all around.
  /// `reference`: kNoId for the first. The frame follows: pose and landmarks are the keyframe's.
  KeyframeId Insert(KeyframeId reference, StereoFrame* frame);

  /// The keyframes that were taken out of the map since the last call.
  std::vector<KeyframeId> TakeRemoved() { return std::exchange(removed_, {}); }

 private:
  void AddPointsOf(KeyframeId keyframe);
  void RemovePoorLandmarks(KeyframeId newest);
  void AddFarPoints(KeyframeId newest);
  void AddFarPointsWith(KeyframeId newest, KeyframeId neighbour);
  void FuseAround(KeyframeId newest);
  void FuseInto(KeyframeId newest, KeyframeId neighbour);
  void RemoveRedundant(KeyframeId newest);
  bool IsRedundant(const StereoKeyframe& keyframe) const;
  bool ShareKeyframe(const StereoLandmark& first, const StereoLandmark& second) const;
  bool Fits(KeyframeId keyframe, size_t feature, const Eigen::Vector3d& point_world) const;

  StereoOptions options_;
  StereoMap* map_;
  LandmarkSearch search_;
  LandmarkAligner aligner_;
  double close_depth_;                ///< m
  std::vector<LandmarkId> on_trial_;  ///< landmarks of the last keyframes
  std::vector<KeyframeId> removed_;
};

}  // namespace regolith
