// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include <tf2_msgs/TFMessage.h>

#include "regolith/ros/slam_outputs_internal.h"
#include "regolith/system/map_builder.h"

namespace regolith {
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
      refresh_pace_(setup.options.map_period),
      image_pace_(1.0 / setup.options.image_rate),
      tf_pace_(1.0 / setup.options.tf_rate) {
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

void SlamOutputs::AfterMeasurement(SlamSystem& system, const SensorEvent* event,
                                   const std::vector<FrameReport>& reports) {
  Draw(system, event);
  waiting_.insert(waiting_.end(), reports.begin(), reports.end());
  while (!waiting_.empty()) {
    const FrameReport report = std::move(waiting_.front());
    waiting_.pop_front();
    Note(report);
    if (HasPose(report)) AfterPose(system, report);
  }
}

/// Images have the pipeline's pose where visual odometry leads.
bool SlamOutputs::HasPose(const FrameReport& report) const {
  if (report.source == FrameSource::kScan) return true;
  const bool leads = setup_.pipeline.odometry == OdometryKind::kVio || !setup_.rig.lidar;
  return leads && report.visual.has_value();
}

void SlamOutputs::AfterPose(SlamSystem& system, const FrameReport& report) {
  const SlamNodeOptions& options = setup_.options;
  const SE3 T_map_odom = system.T_map_odom();
  const SE3 T_map_base = T_map_odom * report.T_world_body * T_imu_base_;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom_ = T_map_odom;
  }
  pose_.publish(PoseWithCovariance(report.stamp, T_map_base, report.covariance, options.map_frame));
  if (!system.needs().imu) PublishPoseWithoutImu(report);
  last_pose_ = {report.stamp, report.T_world_body};
  if (refresh_pace_.IsDue()) Refresh(system, report);
  if (!path_pace_.IsDue()) return;
  std::vector<StampedPose> path = key_poses_;
  path.push_back({report.stamp, T_map_base});
  path_.publish(PathMessage(path, options.map_frame));
}

/// Without an IMU there is no more to say than the poses themselves.
void SlamOutputs::PublishPoseWithoutImu(const FrameReport& report) {
  NavState state;
  state.time = report.stamp;
  state.T_world_imu = report.T_world_body;
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  if (last_pose_ && last_pose_->time < state.time) {
    const double seconds = SecondsBetween(last_pose_->time, state.time);
    const SE3& before = last_pose_->T_world_body;
    state.v_world_imu = (state.T_world_imu.translation - before.translation) / seconds;
    const Eigen::AngleAxisd turn(before.rotation.conjugate() * state.T_world_imu.rotation);
    rate = turn.angle() / seconds * turn.axis();
  }
  PublishOdometry(state, rate);
}

/// What loops change, and what takes time to ask for.
void SlamOutputs::Refresh(SlamSystem& system, const FrameReport& report) {
  const SlamNodeOptions& options = setup_.options;
  for (FrameReport& more : system.Settle()) waiting_.push_back(std::move(more));
  key_poses_ = KeyPoses(system, T_imu_base_);
  const auto loops = LoopsMessage(system, report.stamp, T_imu_base_, options.map_frame);
  if (!loops.markers.empty()) loops_.publish(loops);
  if (map_.getNumSubscribers() > 0) {
    MapBuilder thinned({options.map_voxel_size, options.map_max_points});
    thinned.Add(system.MapPoints(), 0);
    map_.publish(CloudMessage(report.stamp, thinned.points(), options.map_frame));
  }
  const KeyframeCounts counts = system.keyframe_counts();
  const std::vector<std::string> notices = system.Notices();
  const std::lock_guard<std::mutex> lock(mutex_);
  diagnostics_.keyframes = counts.keyframes;
  diagnostics_.loops = counts.loops_accepted;
  diagnostics_.restarts = system.resets();
  diagnostics_.notices = notices;
}

/// An image is shown as soon as its features are tracked, which is some measurements later.
void SlamOutputs::Draw(const SlamSystem& system, const SensorEvent* event) {
  if (image_.getNumSubscribers() == 0 || event == nullptr) return;
  const auto* const frame = std::get_if<CameraFrame>(event);
  if (frame != nullptr && frame->camera == setup_.pipeline.tracked_camera && !last_frame_ &&
      image_pace_.IsDue()) {
    last_frame_ = *frame;
  }
  if (!last_frame_) return;
  const ImageTracks tracks = system.tracks();
  if (tracks.stamp < last_frame_->time) return;
  // A later one has been tracked already where measurements come in bursts.
  if (tracks.stamp == last_frame_->time) {
    image_.publish(FeaturesMessage(*last_frame_, tracks.features));
  }
  last_frame_.reset();
}

void SlamOutputs::Note(const FrameReport& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (report.visual) diagnostics_.health = VioHealthName(report.visual->health);
  if (!HasPose(report)) return;
  diagnostics_.leader = report.leader;
  diagnostics_.at_rest = report.at_rest;
  diagnostics_.degenerate_directions = report.degenerate_directions;
  if (last_pose_) {
    diagnostics_.distance +=
        (report.T_world_body.translation - last_pose_->T_world_body.translation).norm();
  }
  diagnostics_.has_pose = true;
  ++diagnostics_.poses;
}

void SlamOutputs::AfterReset() {
  last_frame_.reset();
  last_pose_.reset();
  key_poses_.clear();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_map_odom_ = SE3();
    PipelineDiagnostics fresh;
    fresh.pipeline = diagnostics_.pipeline;
    diagnostics_ = fresh;
  }
  path_.publish(PathMessage({}, setup_.options.map_frame));
  map_.publish(CloudMessage(0, {}, setup_.options.map_frame));
}

PipelineDiagnostics SlamOutputs::diagnostics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return diagnostics_;
}

}  // namespace regolith
