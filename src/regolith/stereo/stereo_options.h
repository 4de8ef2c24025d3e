// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// How the keypoints of both eyes are brought together.
struct EpipolarMatcherOptions {
  double nearest = 0.4;          ///< m; what would be nearer is no match
  double row_tolerance = 2.0;    ///< pixels, times the scale of the keypoint
  int max_hamming = 75;          ///< bits, binary descriptors
  double min_similarity = 0.6;   ///< inner product, float descriptors
  double max_scale_ratio = 1.5;  ///< between the scales of both keypoints
  double min_correlation = 0.8;  ///< of the patches around them
  double min_disparity = 0.3;    ///< pixels; less says nothing of the distance

  void Check() const;
};

/// How landmarks are found in an image.
struct LandmarkSearchOptions {
  int max_hamming = 80;          ///< bits, binary descriptors
  double min_similarity = 0.6;   ///< inner product, float descriptors
  double frame_ratio = 0.9;      ///< of the descriptors' distances, from image to image
  double keyframe_ratio = 0.8;   ///< where nothing is known of the motion
  double frame_radius = 15.0;    ///< pixels, times the scale, around a predicted place
  double map_radius = 4.0;       ///< pixels, times the scale, once the pose is about known
  double max_scale_ratio = 1.5;  ///< between the scale expected and the one found
  double max_view_angle = 1.05;  ///< rad between the views of a landmark

  void Check() const;
};

/// How keypoints are moved to their landmarks by what the images look like around them.
struct PatchAlignmentOptions {
  bool enabled = true;           ///< of features that are found in the image itself, at one scale
  double min_correlation = 0.7;  ///< of the patches, of a landmark that is seen
  double max_step = 2.5;         ///< pixels from where the keypoint was detected

  void Check() const;
};

/// How exactly keypoints say where a point is seen, 1 σ.
struct SightingNoise {
  double pixel = 0.5;          ///< pixels at scale 1, of a place as it was detected
  double aligned_pixel = 0.3;  ///< pixels, of a place that was aligned
  double disparity = 0.3;      ///< pixels, at any scale

  void Check() const;
};

/// A bundle adjustment of the keyframes around the newest one.
struct LocalAdjustmentOptions {
  int keyframes = 8;         ///< that move
  int fixed_keyframes = 12;  ///< that hold them, of those that see the same landmarks
  int max_landmarks = 1500;  ///< those with the most sightings
  int iterations = 5;        ///< of the solver

  void Check() const;
};

/// Stereo odometry with a local map, after ORB-SLAM2 (Mur-Artal & Tardós 2017).
struct StereoOptions {
  EpipolarMatcherOptions epipolar;
  LandmarkSearchOptions search;
  PatchAlignmentOptions alignment;
  SightingNoise noise;
  LocalAdjustmentOptions adjustment;
  double close_baselines = 40.0;  ///< a point is close that is nearer than so many baselines
  int min_start_points = 100;     ///< keypoints with a distance, for a start
  int min_matches = 20;           ///< with the last image; with fewer the search is widened
  int min_inliers = 30;           ///< landmarks that agree with a pose, with fewer it is lost
  int min_relocalised = 50;       ///< the same, to find the way again
  /// A keyframe is made where the landmarks tracked fall below this share of the reference's …
  double keyframe_share = 0.75;
  int min_close_tracked = 100;    ///< … or fewer close points than this are tracked …
  int min_close_new = 70;         ///< … and so many more would be there …
  double max_keyframe_gap = 2.0;  ///< … or so many s have passed while it moved
  int min_new_points = 100;       ///< that a keyframe makes, far ones too
  double min_found_share = 0.25;  ///< of the images that should see a new landmark
  double redundant_share = 0.9;   ///< of a keyframe's landmarks that three others see: it goes
  int place_candidates = 5;       ///< most similar keyframes that are tried once it is lost
  int full_keyframes = 60;        ///< the newest; older ones keep only features with landmarks
  /// What odometry drifts by, for loops: 1 σ a √m driven.
  double drift_position = 0.02;   ///< m
  double drift_rotation = 0.003;  ///< rad

  void Check() const;
};

}  // namespace regolith
