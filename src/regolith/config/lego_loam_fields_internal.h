// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/lio/lego_loam_options.h"

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, GroundSegmentationOptions& ground) {
  archive("seed_slope_deg", ground.seed_slope_deg);
  archive("max_slope_deg", ground.max_slope_deg);
  archive("max_bend_deg", ground.max_bend_deg);
  archive("max_step", ground.max_step);
}

template <typename Archive>
void Fields(Archive& archive, ClusterSegmentationOptions& clusters) {
  archive("min_angle_deg", clusters.min_angle_deg);
  archive("min_points", clusters.min_points);
  archive("min_points_across", clusters.min_points_across);
  archive("min_rings", clusters.min_rings);
}

template <typename Archive>
void Fields(Archive& archive, CurvatureFeatureOptions& features) {
  archive("neighbours", features.neighbours);
  archive("sectors", features.sectors);
  archive("sharp_edges", features.sharp_edges);
  archive("edges", features.edges);
  archive("flat_planars", features.flat_planars);
  archive("edge_curvature", features.edge_curvature);
  archive("planar_curvature", features.planar_curvature);
  archive("occlusion_step", features.occlusion_step);
  archive("occlusion_share", features.occlusion_share);
  archive("grazing_share", features.grazing_share);
}

template <typename Archive>
void Fields(Archive& archive, SegmentationOptions& segmentation) {
  archive("ground", segmentation.ground);
  archive("clusters", segmentation.clusters);
  archive("features", segmentation.features);
}

template <typename Archive>
void Fields(Archive& archive, TwoStepMatcherOptions& odometry) {
  archive("max_distance", odometry.max_distance);
  archive("max_searches", odometry.max_searches);
  archive("steps_per_search", odometry.steps_per_search);
  archive("range_sigma", odometry.range_sigma);
  archive("rotation_tolerance", odometry.rotation_tolerance);
  archive("position_tolerance", odometry.position_tolerance);
  archive("min_matches", odometry.min_matches);
  archive("min_eigenvalue", odometry.min_eigenvalue);
}

template <typename Archive>
void Fields(Archive& archive, FeatureMapOptions& map) {
  archive("edge_spacing", map.edge_spacing);
  archive("planar_spacing", map.planar_spacing);
  archive("radius", map.radius);
  archive("search_distance", map.search_distance);
  archive("coarse_growth", map.coarse_growth);
  archive("neighbours", map.neighbours);
  archive("line_ratio", map.line_ratio);
  archive("plane_thickness", map.plane_thickness);
  archive("plane_ratio", map.plane_ratio);
  archive("range_sigma", map.range_sigma);
  archive("max_searches", map.max_searches);
  archive("steps_per_search", map.steps_per_search);
  archive("rotation_tolerance", map.rotation_tolerance);
  archive("position_tolerance", map.position_tolerance);
  archive("min_matches", map.min_matches);
  archive("min_eigenvalue", map.min_eigenvalue);
}

template <typename Archive>
void Fields(Archive& archive, KeyframeGraphOptions& keyframes) {
  archive("close_loops", keyframes.close_loops);
  archive("distance", keyframes.distance);
  archive("angle", keyframes.angle);
  archive("search_radius", keyframes.search_radius);
  archive("min_age", keyframes.min_age);
  archive("interval", keyframes.interval);
  archive("submap_keyframes", keyframes.submap_keyframes);
  archive("min_overlap", keyframes.min_overlap);
  archive("max_scale", keyframes.max_scale);
  archive("max_correction", keyframes.max_correction);
  archive("step_rotation_sigma", keyframes.step_rotation_sigma);
  archive("step_position_sigma", keyframes.step_position_sigma);
  archive("loop_rotation_sigma", keyframes.loop_rotation_sigma);
  archive("loop_position_sigma", keyframes.loop_position_sigma);
}

template <typename Archive>
void Fields(Archive& archive, LegoLoamOptions& lego_loam) {
  archive("segmentation", lego_loam.segmentation);
  archive("odometry", lego_loam.odometry);
  archive("map", lego_loam.map);
  archive("keyframes", lego_loam.keyframes);
  archive("deskew", lego_loam.deskew);
  archive("velocity_rotation_sigma", lego_loam.velocity_rotation_sigma);
  archive("velocity_position_sigma", lego_loam.velocity_position_sigma);
  archive("independence", lego_loam.independence);
}

}  // namespace regolith
