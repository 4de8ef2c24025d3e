// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/pipeline_config.h"

#include "regolith/config/features_fields_internal.h"
#include "regolith/config/lego_loam_fields_internal.h"
#include "regolith/core/error.h"

namespace regolith {

template <typename Archive>
void Fields(Archive& archive, VoxelMapOptions& map) {
  archive("voxel_size", map.voxel_size);
  archive("max_points_per_voxel", map.max_points_per_voxel);
  archive("radius", map.radius);
  archive("max_voxels", map.max_voxels);
}

template <typename Archive>
void Fields(Archive& archive, PointToPlaneOptions& planes) {
  archive("neighbours", planes.neighbours);
  archive("min_neighbours", planes.min_neighbours);
  archive("max_thickness_ratio", planes.max_thickness_ratio);
  archive("min_width_ratio", planes.min_width_ratio);
  archive("search_again_distance", planes.search_again_distance);
  archive("range_sigma", planes.range_sigma);
  archive("independence", planes.independence);
}

template <typename Archive>
void Fields(Archive& archive, ScanMatcherOptions& matcher) {
  archive("planes", matcher.planes);
  archive("max_searches", matcher.max_searches);
  archive("steps_per_search", matcher.steps_per_search);
  archive("rotation_tolerance", matcher.rotation_tolerance);
  archive("position_tolerance", matcher.position_tolerance);
  archive("min_matches", matcher.min_matches);
  archive("degenerate_ratio", matcher.degenerate_ratio);
}

template <typename Archive>
void Fields(Archive& archive, FeatureScanMatcherOptions& matcher) {
  archive("curvature", matcher.curvature);
  archive("map", matcher.map);
  archive("independence", matcher.independence);
}

template <typename Archive>
void Fields(Archive& archive, RestDetectionOptions& rest) {
  archive("min_duration", rest.min_duration);
  archive("max_gyro_sigma", rest.max_gyro_sigma);
  archive("max_force_sigma_share", rest.max_force_sigma_share);
  archive("max_mean_rate", rest.max_mean_rate);
  archive("max_force_error_share", rest.max_force_error_share);
}

template <typename Archive>
void Fields(Archive& archive, MapDriftOptions& drift) {
  archive("rotation_length", drift.rotation_length);
  archive("position_length", drift.position_length);
}

template <typename Archive>
void Fields(Archive& archive, WheelVelocityOptions& wheels) {
  archive("slip_sigma", wheels.slip_sigma);
  archive("slip_walk", wheels.slip_walk);
  archive("velocity_sigma", wheels.velocity_sigma);
  archive("lateral_share", wheels.lateral_share);
  archive("vertical_share", wheels.vertical_share);
  archive("turn_share", wheels.turn_share);
}

template <typename Archive>
void Fields(Archive& archive, WheelPreintegrationOptions& wheels) {
  archive("distance_sigma_share", wheels.distance_sigma_share);
  archive("lateral_sigma_share", wheels.lateral_sigma_share);
  archive("vertical_sigma_share", wheels.vertical_sigma_share);
  archive("yaw_sigma_share", wheels.yaw_sigma_share);
  archive("yaw_sigma_per_metre", wheels.yaw_sigma_per_metre);
  archive("tilt_sigma_per_metre", wheels.tilt_sigma_per_metre);
  archive("floor_position_sigma", wheels.floor_position_sigma);
  archive("floor_rotation_sigma", wheels.floor_rotation_sigma);
}

template <typename Archive>
void Fields(Archive& archive, InertialFilterOptions& filter) {
  archive("rest_velocity_sigma", filter.rest_velocity_sigma);
  archive("moving_velocity_sigma", filter.moving_velocity_sigma);
  archive("moving_tilt_sigma", filter.moving_tilt_sigma);
  archive("noise_inflation", filter.noise_inflation);
  archive("wheels", filter.wheels);
}

template <typename Archive>
void Fields(Archive& archive, LidarOdometryOptions& lio) {
  archive("lidar", lio.lidar);
  archive("imu", lio.imu);
  archive("wheels", lio.wheels);
  archive("map", lio.map);
  archive("map_levels", lio.map_levels);
  archive("map_growth", lio.map_growth);
  archive("scan_voxel_size", lio.scan_voxel_size);
  archive("max_points", lio.max_points);
  archive("drift", lio.drift);
  archive("matcher", lio.matcher);
  archive("features", lio.features);
  archive("feature_matcher", lio.feature_matcher);
  archive("initialization_window", lio.initialization_window);
  archive("rest", lio.rest);
  archive("rest_window", lio.rest_window);
  archive("rest_max_speed", lio.rest_max_speed);
  archive("rest_max_rate", lio.rest_max_rate);
  archive("filter", lio.filter);
  archive("velocity_rotation_sigma", lio.velocity_rotation_sigma);
  archive("velocity_position_sigma", lio.velocity_position_sigma);
  archive("wheel_motion", lio.wheel_motion);
  archive("min_imu_rate", lio.min_imu_rate);
  archive("max_imu_gap", lio.max_imu_gap);
}

template <typename Archive>
void Fields(Archive& archive, MapBuilderOptions& map) {
  archive("voxel_size", map.voxel_size);
  archive("max_points", map.max_points);
}

template <typename Archive>
void OdometryField(Archive& archive, OdometryKind& odometry) {
  std::string name = odometry == OdometryKind::kLegoLoam ? "lego_loam" : "lio";
  archive("odometry", name);
  if constexpr (Archive::kReading) {
    if (name != "lio" && name != "lego_loam") {
      archive.Fail("odometry", "`" + name + "`: expected lio or lego_loam");
    }
    odometry = name == "lego_loam" ? OdometryKind::kLegoLoam : OdometryKind::kLio;
  }
}

template <typename Archive>
void Fields(Archive& archive, PipelineOptions& options) {
  archive("pipeline", options.name);
  archive("tracked_camera", options.tracked_camera);
  archive("features", options.features);
  OdometryField(archive, options.odometry);
  archive("lio", options.lio);
  archive("lego_loam", options.lego_loam);
  archive("map", options.map);
}

PipelineOptions LoadPipeline(const YamlDocument& document) {
  PipelineOptions options;
  FieldReader reader(document);
  Fields(reader, options);
  reader.Finish();
  try {
    options.features.Check();
    options.lio.Check();
    options.lego_loam.Check();
    options.map.Check();
  } catch (const CheckError& error) {
    throw InputError(document.name(), error.what());
  }
  return options;
}

std::string WritePipeline(const PipelineOptions& options) {
  FieldWriter writer;
  PipelineOptions copy = options;
  Fields(writer, copy);
  return writer.Text();
}

}  // namespace regolith
