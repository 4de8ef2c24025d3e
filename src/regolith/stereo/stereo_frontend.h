// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "regolith/core/stopwatch.h"
#include "regolith/core/thread_pool.h"
#include "regolith/features/feature_extractor.h"
#include "regolith/sensor/image.h"
#include "regolith/stereo/epipolar_matcher.h"
#include "regolith/stereo/stereo_options.h"
#include "regolith/stereo/stereo_rectifier.h"

namespace regolith {

/// What a pair of images gave.
struct StereoObservation {
  StereoFeatures features;
  int left_keypoints = 0;
  int right_keypoints = 0;
  int with_distance = 0;      ///< of the left ones
  DetectionStatus detection;  ///< of the left image
  std::vector<StageTime> stages;
};

/// From two images to keypoints with distances: rectifies, extracts (an eye a thread), matches.
class StereoFrontend {
 public:
  /// `mask`: of the left camera, as large as its images and 0 where the rover sees itself. Throws
  /// InputError where the cameras make no pair, or the features have no descriptors.
  StereoFrontend(const FeatureOptions& features, const std::optional<ModelManifest>& model,
                 const StereoOptions& options, const CameraIntrinsics& left,
                 const CameraIntrinsics& right, const SE3& T_left_right,
                 const std::optional<Image>& mask, ThreadPool* threads);

  const RectifiedCamera& camera() const { return rectifier_.camera(); }
  /// The rectified camera's frame into the left camera's.
  const SE3& T_left_rectified() const { return rectifier_.T_left_rectified(); }

  /// Throws InputError where pair after pair only fits with left and right exchanged.
  StereoObservation Observe(const Image& left, const Image& right);

 private:
  void CheckOrder(const FeatureSet& left, const FeatureSet& right, int with_distance);

  StereoRectifier rectifier_;
  Image left_mask_;
  Image right_mask_;
  int max_keypoints_;
  bool cuts_patches_;
  std::unique_ptr<FeatureExtractor> left_;
  std::unique_ptr<FeatureExtractor> right_;
  EpipolarMatcher matcher_;
  ThreadPool* threads_;
  int reversed_pairs_ = 0;  ///< in a row
};

}  // namespace regolith
