// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include <tf2_msgs/TFMessage.h>

#include "regolith/ros/slam_outputs_internal.h"
#include "regolith/system/map_builder.h"

namespace regolith {
namespace {

constexpr double kNotePeriod = 0.2;  // s

SE3 MapFromOdom(const SlamSystem& system) {
  if (const Backend* const backend = system.backend()) return backend->T_world_odom();
  return SE3();
}

}  // namespace

bool Pace::IsDue() {
  const Clock::time_point now = Clock::now();
  if (last_ && now - *last_ < period_) return false;
  last_ = now;
  return true;
}

SlamOutputs::SlamOutputs(const NodeSetup& setup, ros::NodeHandle private_node)
    : setup_(setup),
      T_imu_base_(setup.T_imu_base),
      odometry_(private_node.advertise<nav_msgs::Odometry>("odom", 400)),
      pose_(private_node.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 50)),
      path_(private_node.advertise<nav_msgs::Path>("path", 2, true)),
      map_(private_node.advertise<sensor_msgs::PointCloud2>("map", 1, true)),
      image_(private_node.advertise<sensor_msgs::Image>("features", 2)),
      loops_(private_node.advertise<visualization_msgs::MarkerArray>("loops", 1, true)),
      tf_(private_node.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      tf_static_(private_node.advertise<tf2_msgs::TFMessage>("/tf_static", 10, true)),
      path_pace_(1.0 / setup.options.path_rate),
      map_pace_(setup.options.map_period),
      image_pace_(1.0 / setup.options.image_rate),
      tf_pace_(1.0 / setup.options.tf_rate),
      note_pace_(kNotePeriod) {
  diagnostics_.pipeline = setup.pipeline.name;
  PublishSensorFrames();
}

void SlamOutputs::PublishSensorFrames() {
  if (!setup_.options.publish_sensor_frames) return;
  const SE3 T_base_imu = T_imu_base_.Inverse();
  tf2_msgs::TFMessage message;
  const auto add = [&](const std::string& frame, const SE3& T_imu_frame) {
    message.transforms.push_back(
        TransformMessage(0, setup_.options.base_frame, frame, T_base_imu * T_imu_frame));
  };
  if (setup_.rig.imu) add("imu", SE3());
  if (setup_.rig.lidar) add("lidar", setup_.rig.lidar->T_imu_lidar);
  for (const auto& [name, camera] : setup_.rig.cameras) add(name, camera.T_imu_camera);
  tf_static_.publish(message);
}

void SlamOutputs::PublishOdometry(const NavState& state, const Eigen::Vector3d& rate) {
  const SlamNodeOptions& options = setup_.options;
  odometry_.publish(
      OdometryMessage(state, rate, T_imu_base_, options.odom_frame, options.base_frame));
  if (!options.publish_tf || !tf_pace_.IsDue()) return;
  SE3 T_map_odom;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom = T_map_odom_;
  }
  tf2_msgs::TFMessage message;
  message.transforms.push_back(
      TransformMessage(state.time, options.map_frame, options.odom_frame, T_map_odom));
  message.transforms.push_back(TransformMessage(state.time, options.odom_frame, options.base_frame,
                                                state.T_world_imu * T_imu_base_));
  tf_.publish(message);
}

void SlamOutputs::AfterMeasurement(const SlamSystem& system, const SensorEvent& event,
                                   const std::vector<FrameReport>& reports) {
  Draw(system, event);
  if (reports.empty()) return;
  const bool has_scans = system.scans_seen() > 0;
  for (const FrameReport& report : reports) {
    const bool is_pose = report.source == FrameSource::kScan || (!has_scans && report.visual);
    if (is_pose && !system.odometry().empty()) AfterPose(system, report);
  }
  if (note_pace_.IsDue()) Note(system, reports);
}

void SlamOutputs::AfterPose(const SlamSystem& system, const FrameReport& report) {
  const SlamNodeOptions& options = setup_.options;
  const SE3 T_map_odom = MapFromOdom(system);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom_ = T_map_odom;
  }
  pose_.publish(PoseWithCovariance(report.stamp, T_map_odom * report.T_world_body * T_imu_base_,
                                   report.covariance, options.map_frame));
  if (path_pace_.IsDue()) {
    path_.publish(PathMessage(system, T_imu_base_, options.map_frame));
    const auto loops = LoopsMessage(system, report.stamp, options.map_frame);
    if (!loops.markers.empty()) loops_.publish(loops);
  }
  if (map_.getNumSubscribers() > 0 && map_pace_.IsDue()) {
    MapBuilder thinned({options.map_voxel_size, options.map_max_points});
    thinned.Add(system.MapPoints(), 0);
    map_.publish(CloudMessage(report.stamp, thinned.points(), options.map_frame));
  }
}

/// An image is shown as soon as its features are tracked; of a stereo pair that is when the other
/// image has come.
void SlamOutputs::Draw(const SlamSystem& system, const SensorEvent& event) {
  if (image_.getNumSubscribers() == 0) return;
  const auto* const frame = std::get_if<CameraFrame>(&event);
  if (frame == nullptr) return;
  if (frame->camera == setup_.pipeline.tracked_camera && image_pace_.IsDue()) last_frame_ = *frame;
  if (!last_frame_ || system.tracks().stamp != last_frame_->time) return;
  image_.publish(FeaturesMessage(*last_frame_, system.tracks().features));
  last_frame_.reset();
}

void SlamOutputs::Note(const SlamSystem& system, const std::vector<FrameReport>& reports) {
  const KeyframeCounts counts = system.keyframe_counts();
  const std::vector<std::string> notices = system.Notices();
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const FrameReport& report : reports) {
    if (report.visual) diagnostics_.health = VioHealthName(report.visual->health);
    if (report.source != FrameSource::kScan && system.scans_seen() > 0) continue;
    diagnostics_.leader = report.leader;
    diagnostics_.at_rest = report.at_rest;
    diagnostics_.degenerate_directions = report.degenerate_directions;
  }
  diagnostics_.has_pose = !system.odometry().empty();
  diagnostics_.poses = system.odometry().size();
  diagnostics_.distance = system.odometry().Length();
  diagnostics_.keyframes = counts.keyframes;
  diagnostics_.loops = counts.loops_accepted;
  diagnostics_.restarts = system.resets();
  diagnostics_.notices = notices;
}

void SlamOutputs::AfterReset(const SlamSystem& system) {
  last_frame_.reset();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom_ = SE3();
    PipelineDiagnostics fresh;
    fresh.pipeline = diagnostics_.pipeline;
    diagnostics_ = fresh;
  }
  path_.publish(PathMessage(system, T_imu_base_, setup_.options.map_frame));
  map_.publish(CloudMessage(0, {}, setup_.options.map_frame));
}

PipelineDiagnostics SlamOutputs::diagnostics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return diagnostics_;
}

}  // namespace regolith
