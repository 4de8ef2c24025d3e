// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Not one of the exported headers: it names ROS types, and is for .cc files only.
#include <string>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "regolith/cloud/map_point.h"
#include "regolith/core/span.h"
#include "regolith/geometry/nav_state.h"
#include "regolith/ros/topic_input.h"
#include "regolith/sensor/image.h"
#include "regolith/system/live_slam.h"
#include "regolith/system/slam_system.h"

namespace regolith {

geometry_msgs::Pose PoseMessage(const SE3& pose);

geometry_msgs::TransformStamped TransformMessage(TimeNs time, const std::string& parent,
                                                 const std::string& child,
                                                 const SE3& T_parent_child);

/// The base's pose in `odom_frame` and its velocity in its own frame. `rate` (rad/s): of the body,
/// frame `imu`.
nav_msgs::Odometry OdometryMessage(const NavState& state, const Eigen::Vector3d& rate,
                                   const SE3& T_imu_base, const std::string& odom_frame,
                                   const std::string& base_frame);

/// `covariance` as FrameReport has it: rotation on the right, position in the world.
geometry_msgs::PoseWithCovarianceStamped PoseWithCovariance(TimeNs time, const SE3& T_map_base,
                                                            const Matrix6d& covariance,
                                                            const std::string& map_frame);

/// Where the base has been in the map: keyframes where there is a back end, else poses half a metre
/// apart.
std::vector<StampedPose> KeyPoses(const SlamSystem& system, const SE3& T_imu_base);

nav_msgs::Path PathMessage(Span<const StampedPose> poses, const std::string& map_frame);

/// Points of float32 x y z intensity.
sensor_msgs::PointCloud2 CloudMessage(TimeNs time, Span<const MapPoint> points,
                                      const std::string& frame);

/// The image with a mark at each feature: new ones orange, old ones green.
sensor_msgs::Image FeaturesMessage(const CameraFrame& frame, Span<const TrackedFeature> features);

/// Keyframes as points, accepted loops as lines, where the base was.
visualization_msgs::MarkerArray LoopsMessage(const SlamSystem& system, TimeNs time,
                                             const SE3& T_imu_base, const std::string& map_frame);

/// `others`: topics whose messages would fit, where none has come on this one.
diagnostic_msgs::DiagnosticStatus TopicDiagnostics(const std::string& node, const TopicInput& input,
                                                   const TopicStatus& status,
                                                   const EventMerger::Dropped& dropped,
                                                   double silence, const std::string& others);

/// What the node says of the pipeline as a whole.
struct PipelineDiagnostics {
  LiveStatus live;
  size_t newly_dropped = 0;  ///< scans and images since the last report
  std::string pipeline;
  std::string leader;  ///< of the last scan
  std::string health;  ///< of visual odometry; empty without
  bool at_rest = false;
  bool has_pose = false;
  int degenerate_directions = 0;
  size_t poses = 0;
  size_t keyframes = 0;
  size_t loops = 0;
  size_t restarts = 0;    ///< of an odometry that had lost its way
  double distance = 0.0;  ///< m
  std::vector<std::string> notices;
};
diagnostic_msgs::DiagnosticStatus PipelineMessage(const std::string& node,
                                                  const PipelineDiagnostics& state);

}  // namespace regolith
