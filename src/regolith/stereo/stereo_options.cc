// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/stereo/stereo_options.h"

#include "regolith/core/check.h"

namespace regolith {

void EpipolarMatcherOptions::Check() const {
  REGOLITH_CHECK(nearest > 0.0, "nearest=", nearest);
  REGOLITH_CHECK(row_tolerance > 0.0, "row_tolerance=", row_tolerance);
  REGOLITH_CHECK(max_hamming > 0, "max_hamming=", max_hamming);
  REGOLITH_CHECK(min_similarity > 0.0 && min_similarity < 1.0, "min_similarity=", min_similarity);
  REGOLITH_CHECK(max_scale_ratio >= 1.0, "max_scale_ratio=", max_scale_ratio);
  REGOLITH_CHECK(min_correlation > 0.0 && min_correlation < 1.0,
                 "min_correlation=", min_correlation);
  REGOLITH_CHECK(min_disparity > 0.0, "min_disparity=", min_disparity);
}

void LandmarkSearchOptions::Check() const {
  REGOLITH_CHECK(max_hamming > 0, "max_hamming=", max_hamming);
  REGOLITH_CHECK(min_similarity > 0.0 && min_similarity < 1.0, "min_similarity=", min_similarity);
  REGOLITH_CHECK(frame_ratio > 0.0 && frame_ratio <= 1.0, "frame_ratio=", frame_ratio);
  REGOLITH_CHECK(keyframe_ratio > 0.0 && keyframe_ratio <= 1.0, "keyframe_ratio=", keyframe_ratio);
  REGOLITH_CHECK(frame_radius > 0.0, "frame_radius=", frame_radius);
  REGOLITH_CHECK(map_radius > 0.0, "map_radius=", map_radius);
  REGOLITH_CHECK(max_scale_ratio >= 1.0, "max_scale_ratio=", max_scale_ratio);
  REGOLITH_CHECK(max_view_angle > 0.0, "max_view_angle=", max_view_angle);
}

void PatchAlignmentOptions::Check() const {
  REGOLITH_CHECK(min_correlation > 0.0 && min_correlation < 1.0,
                 "min_correlation=", min_correlation);
  REGOLITH_CHECK(max_step > 0.0 && max_step < 4.0, "max_step=", max_step);
}

void SightingNoise::Check() const {
  REGOLITH_CHECK(pixel > 0.0, "pixel=", pixel);
  REGOLITH_CHECK(aligned_pixel > 0.0, "aligned_pixel=", aligned_pixel);
  REGOLITH_CHECK(disparity > 0.0, "disparity=", disparity);
}

void LocalAdjustmentOptions::Check() const {
  REGOLITH_CHECK(keyframes >= 2, "keyframes=", keyframes);
  REGOLITH_CHECK(fixed_keyframes >= 1, "fixed_keyframes=", fixed_keyframes);
  REGOLITH_CHECK(max_landmarks >= 50, "max_landmarks=", max_landmarks);
  REGOLITH_CHECK(iterations >= 1, "iterations=", iterations);
}

void StereoOptions::Check() const {
  epipolar.Check();
  search.Check();
  alignment.Check();
  noise.Check();
  adjustment.Check();
  REGOLITH_CHECK(close_baselines > 0.0, "close_baselines=", close_baselines);
  REGOLITH_CHECK(min_start_points >= 10, "min_start_points=", min_start_points);
  REGOLITH_CHECK(min_matches >= 6, "min_matches=", min_matches);
  REGOLITH_CHECK(min_inliers >= 6, "min_inliers=", min_inliers);
  REGOLITH_CHECK(min_relocalised >= min_inliers, "min_relocalised=", min_relocalised);
  REGOLITH_CHECK(keyframe_share > 0.0 && keyframe_share < 1.0, "keyframe_share=", keyframe_share);
  REGOLITH_CHECK(max_keyframe_gap > 0.0, "max_keyframe_gap=", max_keyframe_gap);
  REGOLITH_CHECK(min_found_share >= 0.0 && min_found_share < 1.0,
                 "min_found_share=", min_found_share);
  REGOLITH_CHECK(redundant_share > 0.0 && redundant_share <= 1.0,
                 "redundant_share=", redundant_share);
  REGOLITH_CHECK(place_candidates >= 1, "place_candidates=", place_candidates);
  REGOLITH_CHECK(full_keyframes >= 10, "full_keyframes=", full_keyframes);
  REGOLITH_CHECK(drift_position > 0.0, "drift_position=", drift_position);
  REGOLITH_CHECK(drift_rotation > 0.0, "drift_rotation=", drift_rotation);
}

}  // namespace regolith
