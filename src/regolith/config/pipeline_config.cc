// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/pipeline_config.h"

#include <array>
#include <utility>

#include "regolith/config/backend_fields_internal.h"
#include "regolith/config/features_fields_internal.h"
#include "regolith/config/lego_loam_fields_internal.h"
#include "regolith/config/stereo_fields_internal.h"

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
void Fields(Archive& archive, RangeJumpOptions& jumps) {
  archive("step", jumps.step);
  archive("slope", jumps.slope);
  archive("max_angle", jumps.max_angle);
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
  archive("placed_inflation", wheels.placed_inflation);
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
  archive("max_lost_sigma", lio.max_lost_sigma);
  archive("range_jumps", lio.range_jumps);
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
void Fields(Archive& archive, VioWheelOptions& wheel) {
  archive("slip_sigma", wheel.slip_sigma);
  archive("slip_walk", wheel.slip_walk);
  archive("along_share", wheel.along_share);
  archive("lateral_share", wheel.lateral_share);
  archive("vertical_share", wheel.vertical_share);
  archive("turn_share", wheel.turn_share);
  archive("floor", wheel.floor);
  archive("loss_scale", wheel.loss_scale);
}

template <typename Archive>
void Fields(Archive& archive, VioOptions& vio) {
  archive("wheels", vio.wheels);
  archive("stereo", vio.stereo);
  archive("keyframes", vio.keyframes);
  archive("max_landmarks", vio.max_landmarks);
  archive("keyframe_iterations", vio.keyframe_iterations);
  archive("frame_iterations", vio.frame_iterations);
  archive("keyframe_parallax", vio.keyframe_parallax);
  archive("keyframe_shared", vio.keyframe_shared);
  archive("keyframe_turn", vio.keyframe_turn);
  archive("pixel_sigma", vio.pixel_sigma);
  archive("loss_scale", vio.loss_scale);
  archive("outlier", vio.outlier);
  archive("min_parallax", vio.min_parallax);
  archive("expected_distance", vio.expected_distance);
  archive("inverse_distance_sigma", vio.inverse_distance_sigma);
  archive("noise_inflation", vio.noise_inflation);
  archive("refine_extrinsics", vio.refine_extrinsics);
  archive("extrinsics_rotation_sigma", vio.extrinsics_rotation_sigma);
  archive("extrinsics_position_sigma", vio.extrinsics_position_sigma);
  archive("refine_time_offset", vio.refine_time_offset);
  archive("zero_velocity", vio.zero_velocity);
  archive("rest_velocity_sigma", vio.rest_velocity_sigma);
  archive("rest_position_sigma", vio.rest_position_sigma);
  archive("rest_rotation_sigma", vio.rest_rotation_sigma);
  archive("rest_pixels", vio.rest_pixels);
  archive("rest_max_rate", vio.rest_max_rate);
  archive("rest", vio.rest);
  archive("rest_window", vio.rest_window);
  archive("initialization_window", vio.initialization_window);
  archive("moving_window", vio.moving_window);
  archive("moving_velocity_sigma", vio.moving_velocity_sigma);
  archive("moving_tilt_sigma", vio.moving_tilt_sigma);
  archive("min_imu_rate", vio.min_imu_rate);
  archive("max_imu_gap", vio.max_imu_gap);
  archive("min_features", vio.min_features);
  archive("max_gyro_bias", vio.max_gyro_bias);
  archive("max_accelerometer_bias", vio.max_accelerometer_bias);
  archive("max_jump_speed", vio.max_jump_speed);
  archive("wheel", vio.wheel);
}

template <typename Archive>
void Fields(Archive& archive, LidarDepthOptions& depth) {
  archive("seconds", depth.seconds);
  archive("metres", depth.metres);
  archive("max_range", depth.max_range);
  archive("spacing", depth.spacing);
  archive("search_angle", depth.search_angle);
  archive("max_returns", depth.max_returns);
  archive("max_thickness", depth.max_thickness);
  archive("max_incidence", depth.max_incidence);
  archive("depth_step", depth.depth_step);
  archive("sigma", depth.sigma);
}

/// In the order of Subsystem.
constexpr std::array<const char*, kSubsystems> kTimeoutNames = {"lidar_timeout", "camera_timeout",
                                                                "wheels_timeout", "imu_timeout"};

template <typename Archive>
void Fields(Archive& archive, SupervisorOptions& supervisor) {
  for (size_t i = 0; i < kSubsystems; ++i) archive(kTimeoutNames[i], supervisor.timeouts[i]);
  archive("poor_measurements", supervisor.poor_measurements);
  archive("return_time", supervisor.return_time);
  archive("max_degenerate_directions", supervisor.max_degenerate_directions);
}

constexpr std::array<std::pair<const char*, OdometryKind>, 4> kOdometryNames = {
    {{"lio", OdometryKind::kLio},
     {"lego_loam", OdometryKind::kLegoLoam},
     {"vio", OdometryKind::kVio},
     {"stereo", OdometryKind::kStereo}}};

template <typename Archive>
void OdometryField(Archive& archive, OdometryKind& odometry) {
  std::string name;
  for (const auto& [known, kind] : kOdometryNames) {
    if (kind == odometry) name = known;
  }
  archive("odometry", name);
  if constexpr (Archive::kReading) {
    for (const auto& [known, kind] : kOdometryNames) {
      if (name == known) {
        odometry = kind;
        return;
      }
    }
    archive.Fail("odometry", "`" + name + "`: expected lio, lego_loam, vio or stereo");
  }
}

template <typename Archive>
void Fields(Archive& archive, VisualLoopOptions& visual_loops) {
  archive("enabled", visual_loops.enabled);
  archive("max_keypoints", visual_loops.max_keypoints);
  archive("scan_distance", visual_loops.scan_distance);
}

template <typename Archive>
void Fields(Archive& archive, PipelineOptions& options) {
  archive("pipeline", options.name);
  archive("tracked_camera", options.tracked_camera);
  archive("features", options.features);
  OdometryField(archive, options.odometry);
  archive("lio", options.lio);
  archive("lego_loam", options.lego_loam);
  archive("visual", options.visual);
  archive("vio", options.vio);
  archive("lidar_depth", options.lidar_depth);
  archive("visual_velocity_sigma", options.visual_velocity_sigma);
  archive("stereo", options.stereo);
  archive("places", options.places);
  archive("visual_loops", options.visual_loops);
  archive("feedback_delay", options.feedback_delay);
  archive("lidar_silence", options.lidar_silence);
  archive("supervisor", options.supervisor);
  archive("backend", options.backend);
  archive("map", options.map);
}

PipelineOptions LoadPipeline(const YamlDocument& document) {
  PipelineOptions options;
  FieldReader reader(document);
  Fields(reader, options);
  reader.Finish();
  reader.Check(options);
  return options;
}

std::string WritePipeline(const PipelineOptions& options) {
  FieldWriter writer;
  PipelineOptions copy = options;
  Fields(writer, copy);
  return writer.Text();
}

}  // namespace regolith
