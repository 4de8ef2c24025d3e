// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Not one of the exported headers: it names ROS types, and is for .cc files only.
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "regolith/ros/node_setup.h"
#include "regolith/ros/ros_messages_internal.h"

namespace regolith {

/// Lets something happen so often at most, by the clock.
class Pace {
 public:
  explicit Pace(double seconds) : period_(seconds) {}
  bool IsDue();

 private:
  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double> period_;
  std::optional<Clock::time_point> last_;
};

/// What a SLAM node publishes. The estimator's thread and that of the callbacks may both call it.
class SlamOutputs {
 public:
  SlamOutputs(const NodeSetup& setup, ros::NodeHandle private_node);

  /// In the estimator's thread, after each measurement (null: after none).
  void AfterMeasurement(SlamSystem& system, const SensorEvent* event,
                        const std::vector<FrameReport>& reports);
  void AfterReset();

  /// The newest state in the frame `odom`, and the body's rate (rad/s, frame `imu`).
  void PublishOdometry(const NavState& state, const Eigen::Vector3d& rate);

  /// What is known of the pipeline, but for the queue.
  PipelineDiagnostics diagnostics() const;

 private:
  void AfterPose(SlamSystem& system, const FrameReport& report);
  void PublishPoseWithoutImu(const FrameReport& report);
  void Refresh(SlamSystem& system, const FrameReport& report);
  void Draw(const SlamSystem& system, const SensorEvent* event);
  void Note(const FrameReport& report);
  bool HasPose(const FrameReport& report) const;
  void PublishSensorFrames();

  const NodeSetup& setup_;
  SE3 T_imu_base_;
  ros::Publisher odometry_;
  ros::Publisher pose_;
  ros::Publisher path_;
  ros::Publisher map_;
  ros::Publisher image_;
  ros::Publisher loops_;
  ros::Publisher tf_;
  ros::Publisher tf_static_;
  Pace path_pace_;
  Pace refresh_pace_;
  Pace image_pace_;
  Pace tf_pace_;
  std::deque<FrameReport> waiting_;        ///< to be told of
  std::optional<CameraFrame> last_frame_;  ///< of the tracked camera, not yet drawn
  std::vector<StampedPose> key_poses_;     ///< of the base in the map, at the last refresh
  std::optional<StampedPose> last_pose_;   ///< of the IMU in `odom`

  mutable std::mutex mutex_;
  SE3 T_map_odom_;
  PipelineDiagnostics diagnostics_;
};

}  // namespace regolith
