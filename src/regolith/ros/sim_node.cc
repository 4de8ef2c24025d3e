// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// regolith_sim_node: a simulated rover that is driven by /cmd_vel, in place of Gazebo. It
// translates messages, nothing else (docs/ros.md).
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include "regolith/config/install_paths.h"
#include "regolith/config/rig_config.h"
#include "regolith/config/ros_node_config.h"
#include "regolith/config/scenario_config.h"
#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/exports/rover_urdf.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/bag_writer.h"
#include "regolith/io/ros1_conversions_internal.h"
#include "regolith/ros/node_main_internal.h"
#include "regolith/ros/ros_messages_internal.h"
#include "regolith/ros/ros_parameters_internal.h"
#include "regolith/sim/live_simulator.h"

namespace regolith {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestLead = 0.25;  // s behind real time, beyond which it is not caught up with
constexpr double kReportPeriod = 5.0;  // s

ScenarioOptions ResolveScenario(const std::string& name, const SimNodeOptions& options,
                                const std::string& settings) {
  YamlDocument document = YamlDocument::FromFile(FindConfig("scenarios", options.scenario));
  if (!settings.empty()) document.Overlay(YamlDocument::FromText(settings, name + "/settings"));
  ScenarioOptions scenario = LoadScenario(document);
  if (options.quality == "draft") scenario.MakeDraft();
  scenario.Check();
  return scenario;
}

sensor_msgs::Image RawImage(const CameraFrame& frame) {
  sensor_msgs::Image message;
  message.header.stamp = ToRosTime(frame.time);
  message.header.frame_id = frame.camera;
  message.width = static_cast<uint32_t>(frame.image.width);
  message.height = static_cast<uint32_t>(frame.image.height);
  message.step = message.width;
  message.encoding = "mono8";
  message.data = frame.image.data;
  return message;
}

/// Lets simulated time run beside the clock's, `rate` times as fast at most.
class RealTime {
 public:
  explicit RealTime(double rate) : rate_(rate) {}

  /// Waits until `time` is due. Where it lies behind, the delay is kept and not caught up with.
  void Wait(TimeNs time) {
    const Clock::time_point now = Clock::now();
    if (!started_) {
      started_ = true;
      wall_ = now;
      simulated_ = time;
    }
    const auto due = wall_ + Seconds(SecondsBetween(simulated_, time) / rate_);
    if (due < now - Seconds(kLongestLead)) {
      wall_ = now;
      simulated_ = time;
    } else if (due > now) {
      std::this_thread::sleep_until(due);
    }
  }

 private:
  static Clock::duration Seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  double rate_;
  bool started_ = false;
  Clock::time_point wall_;
  TimeNs simulated_ = 0;
};

class SimNode {
 public:
  SimNode(const SimNodeOptions& options, const ScenarioOptions& scenario,
          const ros::NodeHandle& private_node)
      : options_(options),
        node_(private_node),
        rig_(LiveSimulator::Rig(scenario, options.camera)),
        pool_(options.threads),
        simulator_(LiveSimulator::Create(scenario, nullptr, options.camera, &pool_)),
        clock_(node_.advertise<rosgraph_msgs::Clock>("/clock", 10)),
        imu_(node_.advertise<sensor_msgs::Imu>(rig_.imu->topic, 200)),
        lidar_(node_.advertise<sensor_msgs::PointCloud2>(rig_.lidar->topic, 5)),
        wheels_(node_.advertise<nav_msgs::Odometry>(rig_.wheels->topic, 50)),
        truth_(node_.advertise<geometry_msgs::PoseStamped>("/ground_truth/pose", 100)),
        joints_(node_.advertise<sensor_msgs::JointState>("/joint_states", 20)),
        tf_(node_.advertise<tf2_msgs::TFMessage>("/tf", 20)),
        tf_static_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", 2, true)),
        diagnostics_(node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 5)),
        pace_(options.rate) {
    for (const auto& [name, camera] : rig_.cameras) {
      image_ = node_.advertise<sensor_msgs::Image>(camera.topic, 5);
      info_ = node_.advertise<sensor_msgs::CameraInfo>(CameraInfoTopic(camera.topic), 5);
    }
    command_ = node_.subscribe<geometry_msgs::Twist>(
        "/cmd_vel", 5, [this](const geometry_msgs::Twist::ConstPtr& twist) {
          simulator_->Command(twist->linear.x, twist->angular.z);
          last_command_ = simulator_->next_time();
        });
    PublishStaticFrames();
  }

  void Run() {
    Clock::time_point reported = Clock::now();
    TimeNs reported_time = simulator_->next_time();
    while (ros::ok()) {
      ros::getGlobalCallbackQueue()->callAvailable();
      const TimeNs time = simulator_->next_time();
      StopWithoutCommands(time);
      const SensorEvent event = simulator_->Next();
      pace_.Wait(time);
      PublishClock(time);
      std::visit([this](const auto& value) { Publish(value); }, event);
      const double wall = std::chrono::duration<double>(Clock::now() - reported).count();
      if (wall < kReportPeriod) continue;
      Report(SecondsBetween(reported_time, time) / wall);
      reported = Clock::now();
      reported_time = time;
    }
  }

 private:
  void StopWithoutCommands(TimeNs time) {
    if (last_command_ == 0 || SecondsBetween(last_command_, time) < options_.command_timeout) {
      return;
    }
    simulator_->Command(0.0, 0.0);
    last_command_ = 0;
  }

  /// At the IMU's rate.
  void PublishClock(TimeNs time) {
    if (time <= last_clock_) return;
    last_clock_ = time;
    rosgraph_msgs::Clock message;
    message.clock = ToRosTime(time);
    clock_.publish(message);
  }

  void Publish(const ImuSample& sample) {
    imu_.publish(ToRos(sample));
    if (++samples_ % 2 == 0) {
      truth_.publish(ToRos(StampedPose{sample.time, simulator_->T_world_imu(sample.time)}));
    }
  }

  void Publish(const LidarScan& scan) { lidar_.publish(ToRos(scan)); }

  void Publish(const WheelOdometry& odometry) {
    wheels_.publish(ToRos(odometry));
    sensor_msgs::JointState joints;
    joints.header.stamp = ToRosTime(odometry.time);
    joints.name = {"front_left_wheel_joint", "front_right_wheel_joint", "rear_left_wheel_joint",
                   "rear_right_wheel_joint"};
    const auto angles = simulator_->wheel_angles();
    joints.position.assign(angles.begin(), angles.end());
    joints_.publish(joints);
    if (!options_.publish_tf) return;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(TransformMessage(odometry.time, "ground_truth", "true_base",
                                                  simulator_->T_world_base(odometry.time)));
    tf_.publish(message);
  }

  void Publish(const CameraFrame& frame) {
    image_.publish(RawImage(frame));
    sensor_msgs::CameraInfo info = ToRos(rig_.cameras.at(frame.camera).intrinsics);
    info.header.stamp = ToRosTime(frame.time);
    info.header.frame_id = frame.camera;
    info_.publish(info);
  }

  /// The robot's description calls base_link `base`.
  void PublishStaticFrames() {
    if (!options_.publish_tf) return;
    tf2_msgs::TFMessage message;
    message.transforms.push_back(TransformMessage(0, "base_link", "base", SE3()));
    tf_static_.publish(message);
  }

  void Report(double factor) {
    diagnostic_msgs::DiagnosticStatus status;
    status.name = ros::this_node::getName().substr(1) + ": simulator";
    status.hardware_id = options_.scenario;
    const bool slow = factor < 0.95 * options_.rate;
    status.level =
        slow ? diagnostic_msgs::DiagnosticStatus::WARN : diagnostic_msgs::DiagnosticStatus::OK;
    status.message = Concatenate("time runs ", factor, " times as fast as the clock");
    diagnostic_msgs::KeyValue obstacle;
    obstacle.key = "obstacle";
    obstacle.value = simulator_->obstacle();
    status.values.push_back(obstacle);
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ToRosTime(last_clock_);
    message.status.push_back(status);
    diagnostics_.publish(message);
    if (slow) LogWarning(status.message);
    if (!obstacle.value.empty()) LogWarning("the rover stands: " + obstacle.value);
  }

  SimNodeOptions options_;
  ros::NodeHandle node_;
  RigCalibration rig_;
  ThreadPool pool_;
  std::unique_ptr<LiveSimulator> simulator_;
  ros::Publisher clock_;
  ros::Publisher imu_;
  ros::Publisher lidar_;
  ros::Publisher wheels_;
  ros::Publisher image_;
  ros::Publisher info_;
  ros::Publisher truth_;
  ros::Publisher joints_;
  ros::Publisher tf_;
  ros::Publisher tf_static_;
  ros::Publisher diagnostics_;
  ros::Subscriber command_;
  RealTime pace_;
  TimeNs last_command_ = 0;  ///< 0: none that is in force
  TimeNs last_clock_ = 0;
  size_t samples_ = 0;
};

int RunNode() {
  const ros::NodeHandle private_node("~");
  const std::string name = private_node.getNamespace();
  const NodeParameters parameters = ReadParameters(private_node);
  const SimNodeOptions options = LoadSimNode(YamlDocument::FromText(parameters.options, name));
  const ScenarioOptions scenario = ResolveScenario(name, options, parameters.settings);
  // Before the ground is made, since others wait for them.
  private_node.setParam("/robot_description", RoverUrdf(scenario));
  if (!options.rig_out.empty()) {
    WriteFile(options.rig_out, WriteRig(LiveSimulator::Rig(scenario, options.camera)));
  }
  LogInfo("scenario " + options.scenario + ", " + options.quality +
          " quality; making the ground takes some seconds");
  SimNode node(options, scenario, private_node);
  LogInfo("driving");
  node.Run();
  return 0;
}

}  // namespace
}  // namespace regolith

int main(int argc, char** argv) {
  return regolith::NodeMain(argc, argv, "rover", regolith::RunNode);
}
