// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/backend/backend_options.h"

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, KeyframeOptions& keyframes) {
  archive("distance", keyframes.distance);
  archive("angle", keyframes.angle);
  archive("seconds", keyframes.seconds);
  archive("point_spacing", keyframes.point_spacing);
  archive("radius", keyframes.radius);
  archive("submap_length", keyframes.submap_length);
  archive("floor_rotation_sigma", keyframes.floor_rotation_sigma);
  archive("floor_position_sigma", keyframes.floor_position_sigma);
  archive("gravity_sigma", keyframes.gravity_sigma);
}

template <typename Archive>
void Fields(Archive& archive, LoopSearchOptions& search) {
  archive("min_age", search.min_age);
  archive("min_way", search.min_way);
  archive("max_distance", search.max_distance);
  archive("sigmas", search.sigmas);
  archive("max_doubt", search.max_doubt);
  archive("least_doubt", search.least_doubt);
  archive("least_yaw_doubt", search.least_yaw_doubt);
  archive("max_yaw_doubt", search.max_yaw_doubt);
  archive("max_candidates", search.max_candidates);
}

template <typename Archive>
void Fields(Archive& archive, ReliefMatchOptions& relief) {
  archive("cell_size", relief.cell_size);
  archive("radius", relief.radius);
  archive("yaw_step", relief.yaw_step);
  archive("min_overlap", relief.min_overlap);
  archive("min_cells", relief.min_cells);
}

template <typename Archive>
void Fields(Archive& archive, LoopVerifierOptions& verifier) {
  archive("relief", verifier.relief);
  archive("try_agreement", verifier.try_agreement);
  archive("min_agreement", verifier.min_agreement);
  archive("max_ambiguity", verifier.max_ambiguity);
  archive("separation", verifier.separation);
  archive("yaw_separation", verifier.yaw_separation);
  archive("matcher", verifier.matcher);
  archive("voxel_size", verifier.voxel_size);
  archive("point_spacing", verifier.point_spacing);
  archive("max_points", verifier.max_points);
  archive("min_matches", verifier.min_matches);
  archive("max_scale", verifier.max_scale);
  archive("max_correction", verifier.max_correction);
  archive("max_turn", verifier.max_turn);
  archive("floor_rotation_sigma", verifier.floor_rotation_sigma);
  archive("floor_position_sigma", verifier.floor_position_sigma);
}

template <typename Archive>
void Fields(Archive& archive, LoopConsistencyOptions& consistency) {
  archive("max_squared_distance", consistency.max_squared_distance);
  archive("odometry_inflation", consistency.odometry_inflation);
  archive("confirming_squared_distance", consistency.confirming_squared_distance);
  archive("min_support", consistency.min_support);
  archive("support_sigma", consistency.support_sigma);
  archive("support_distance", consistency.support_distance);
  archive("max_loops", consistency.max_loops);
}

template <typename Archive>
void Fields(Archive& archive, MergeOptions& merge) {
  archive("enabled", merge.enabled);
  archive("max_distance", merge.max_distance);
  archive("delay", merge.delay);
}

template <typename Archive>
void Fields(Archive& archive, FactorGraphOptions& graph) {
  archive("max_iterations", graph.max_iterations);
  archive("robust_width", graph.robust_width);
}

template <typename Archive>
void Fields(Archive& archive, BackendOptions& backend) {
  archive("enabled", backend.enabled);
  archive("close_loops", backend.close_loops);
  archive("keyframes", backend.keyframes);
  archive("search", backend.search);
  archive("verifier", backend.verifier);
  archive("consistency", backend.consistency);
  archive("merge", backend.merge);
  archive("graph", backend.graph);
}

}  // namespace regolith
