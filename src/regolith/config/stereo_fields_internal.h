// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/config/features_fields_internal.h"
#include "regolith/system/pipeline_options.h"

// The keys of `stereo:` and `places:`.

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, EpipolarMatcherOptions& epipolar) {
  archive("nearest", epipolar.nearest);
  archive("row_tolerance", epipolar.row_tolerance);
  archive("max_hamming", epipolar.max_hamming);
  archive("min_similarity", epipolar.min_similarity);
  archive("max_scale_ratio", epipolar.max_scale_ratio);
  archive("min_correlation", epipolar.min_correlation);
  archive("min_disparity", epipolar.min_disparity);
}

template <typename Archive>
void Fields(Archive& archive, LandmarkSearchOptions& search) {
  archive("max_hamming", search.max_hamming);
  archive("min_similarity", search.min_similarity);
  archive("frame_ratio", search.frame_ratio);
  archive("keyframe_ratio", search.keyframe_ratio);
  archive("frame_radius", search.frame_radius);
  archive("map_radius", search.map_radius);
  archive("max_scale_ratio", search.max_scale_ratio);
  archive("max_view_angle", search.max_view_angle);
}

template <typename Archive>
void Fields(Archive& archive, PatchAlignmentOptions& alignment) {
  archive("enabled", alignment.enabled);
  archive("min_correlation", alignment.min_correlation);
  archive("max_step", alignment.max_step);
}

template <typename Archive>
void Fields(Archive& archive, SightingNoise& noise) {
  archive("pixel", noise.pixel);
  archive("aligned_pixel", noise.aligned_pixel);
  archive("disparity", noise.disparity);
}

template <typename Archive>
void Fields(Archive& archive, LocalAdjustmentOptions& adjustment) {
  archive("keyframes", adjustment.keyframes);
  archive("fixed_keyframes", adjustment.fixed_keyframes);
  archive("max_landmarks", adjustment.max_landmarks);
  archive("iterations", adjustment.iterations);
}

template <typename Archive>
void Fields(Archive& archive, StereoOptions& stereo) {
  archive("epipolar", stereo.epipolar);
  archive("search", stereo.search);
  archive("alignment", stereo.alignment);
  archive("noise", stereo.noise);
  archive("adjustment", stereo.adjustment);
  archive("close_baselines", stereo.close_baselines);
  archive("min_start_points", stereo.min_start_points);
  archive("min_matches", stereo.min_matches);
  archive("min_inliers", stereo.min_inliers);
  archive("min_relocalised", stereo.min_relocalised);
  archive("keyframe_share", stereo.keyframe_share);
  archive("min_close_tracked", stereo.min_close_tracked);
  archive("min_close_new", stereo.min_close_new);
  archive("max_keyframe_gap", stereo.max_keyframe_gap);
  archive("min_new_points", stereo.min_new_points);
  archive("min_found_share", stereo.min_found_share);
  archive("redundant_share", stereo.redundant_share);
  archive("place_candidates", stereo.place_candidates);
  archive("full_keyframes", stereo.full_keyframes);
  archive("drift_position", stereo.drift_position);
  archive("drift_rotation", stereo.drift_rotation);
}

template <typename Archive>
void Fields(Archive& archive, VisualPlacesOptions& places) {
  archive("matched_places", places.matched_places);
  archive("max_places", places.max_places);
  archive("min_inliers", places.min_inliers);
  archive("angle_error", places.angle_error);
  archive("iterations", places.iterations);
  archive("matcher", places.matcher);
  archive("position_doubt", places.position_doubt);
  archive("yaw_doubt", places.yaw_doubt);
  archive("min_similarity", places.min_similarity);
  archive("confirmed_inliers", places.confirmed_inliers);
  archive("confirmed_position", places.confirmed_position);
  archive("confirmed_rotation", places.confirmed_rotation);
  archive("position_sigma", places.position_sigma);
  archive("rotation_sigma", places.rotation_sigma);
}

}  // namespace regolith
