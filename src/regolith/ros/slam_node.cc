// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// regolith_node: a SLAM pipeline fed by the topics of a rover. It translates messages, nothing else
// (docs/ros.md).
#include <chrono>
#include <map>
#include <memory>
#include <mutex>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <topic_tools/shape_shifter.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/io/ply.h"
#include "regolith/io/tum.h"
#include "regolith/ros/node_setup.h"
#include "regolith/ros/ros_parameters_internal.h"
#include "regolith/ros/slam_outputs_internal.h"
#include "regolith/ros/topic_input.h"
#include "regolith/system/live_slam.h"

namespace regolith {
namespace {

constexpr int kWrongInput = 2;
constexpr uint32_t kMessageQueue = 500;

double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class SlamNode {
 public:
  SlamNode(NodeSetup setup, const ros::NodeHandle& private_node)
      : setup_(std::move(setup)),
        private_node_(private_node),
        threads_(setup_.options.threads),
        outputs_(setup_, private_node_),
        live_([this] { return MakeSlamSystem(setup_, &threads_); }, setup_.topics.size(),
              setup_.rig.gravity, setup_.options.live,
              [this](SlamSystem& system, const SensorEvent* event,
                     const std::vector<FrameReport>& reports) {
                outputs_.AfterMeasurement(system, event, reports);
              },
              [this](const std::string& reason) {
                LogWarning("everything begins anew: " + reason);
                outputs_.AfterReset();
              }) {
    for (const SensorTopic& sensor : setup_.topics) inputs_.emplace_back(sensor, setup_.rig);
    for (size_t i = 0; i < inputs_.size(); ++i) Subscribe(i);
    Offer("save_map", [this] { return SaveMap(); });
    Offer("save_trajectory", [this] { return SaveTrajectory(); });
    Offer("reset", [this] {
      live_.Reset("asked for");
      return std::string("begins anew");
    });
    diagnostics_ = private_node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 5);
    // By the wall's clock: that of a simulation may stand still, and then it should be heard too.
    timer_ = private_node_.createWallTimer(ros::WallDuration(setup_.options.diagnostics_period),
                                           [this](const ros::WallTimerEvent&) { Diagnose(); });
  }

 private:
  void Subscribe(size_t input) {
    for (const std::string& topic : inputs_[input].Topics()) {
      subscribers_.push_back(private_node_.subscribe<topic_tools::ShapeShifter>(
          topic, kMessageQueue, [this, input](const topic_tools::ShapeShifter::ConstPtr& message) {
            Receive(input, *message);
          }));
    }
  }

  void Receive(size_t input, const topic_tools::ShapeShifter& message) {
    buffer_.resize(message.size());
    ros::serialization::OStream stream(buffer_.data(), message.size());
    message.write(stream);
    auto event = inputs_[input].Receive(message.getDataType(), buffer_, SteadySeconds());
    if (!event) return;
    const auto* const sample = std::get_if<ImuSample>(&*event);
    const bool is_imu = sample != nullptr;
    const ImuSample imu = is_imu ? *sample : ImuSample();
    live_.Push(input, std::move(*event));
    if (is_imu) PublishPrediction(imu);
  }

  /// At the IMU's rate and without delay; never back in time.
  void PublishPrediction(const ImuSample& sample) {
    const auto state = live_.Predicted();
    if (!state || state->time != sample.time) return;
    outputs_.PublishOdometry(*state, sample.angular_velocity - state->gyro_bias);
  }

  /// A service without arguments; where it writes to is a parameter, read when it is called.
  void Offer(const std::string& name, std::function<std::string()> action) {
    services_.push_back(
        private_node_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
            name, [action = std::move(action)](std_srvs::Trigger::Request&,
                                               std_srvs::Trigger::Response& response) {
              try {
                response.message = action();
                response.success = 1;
              } catch (const std::exception& error) {
                response.message = error.what();
                response.success = 0;
              }
              return true;
            }));
  }

  std::string SaveMap() {
    const std::string path = TextParameter(private_node_, "map_file", "map.ply");
    std::vector<MapPoint> points;
    live_.Ask([&](SlamSystem& system) { points = system.MapPoints(); });
    WritePly(path, points);
    return Concatenate(points.size(), " points written to ", path);
  }

  std::string SaveTrajectory() {
    const std::string path = TextParameter(private_node_, "trajectory_file", "trajectory.tum");
    Trajectory trajectory;
    live_.Ask([&](SlamSystem& system) { trajectory = system.trajectory(); });
    WriteTum(path, trajectory.poses());
    return Concatenate(trajectory.size(), " poses of the IMU written to ", path);
  }

  void Diagnose() {
    const double now = SteadySeconds();
    const std::string node = ros::this_node::getName().substr(1);
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    PipelineDiagnostics pipeline = outputs_.diagnostics();
    pipeline.live = live_.status();
    const size_t dropped = pipeline.live.dropped_scans + pipeline.live.dropped_images;
    pipeline.newly_dropped = dropped - std::exchange(dropped_before_, dropped);
    message.status.push_back(PipelineMessage(node, pipeline));
    for (size_t i = 0; i < inputs_.size(); ++i) {
      message.status.push_back(TopicDiagnostics(node, inputs_[i].sensor(), inputs_[i].Status(now),
                                                live_.dropped(i), setup_.options.silence));
    }
    diagnostics_.publish(message);
    for (const auto& status : message.status) Tell(status);
  }

  /// Whoever watches the terminal alone sees each trouble once.
  void Tell(const diagnostic_msgs::DiagnosticStatus& status) {
    auto& told = told_[status.name];
    if (status.level == told) return;
    told = status.level;
    const std::string line = status.name + ": " + status.message;
    if (status.level == diagnostic_msgs::DiagnosticStatus::OK) {
      LogInfo(line);
    } else {
      LogWarning(line);
    }
  }

  NodeSetup setup_;
  ros::NodeHandle private_node_;
  ThreadPool threads_;
  SlamOutputs outputs_;
  std::vector<TopicInput> inputs_;
  std::vector<uint8_t> buffer_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher diagnostics_;
  ros::WallTimer timer_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus::_level_type> told_;
  size_t dropped_before_ = 0;
  LiveSlam live_;  ///< the last, so that its thread ends first
};

int RunNode() {
  const ros::NodeHandle private_node("~");
  const std::string name = private_node.getNamespace();
  const NodeParameters parameters = ReadParameters(private_node);
  NodeSetup setup = ResolveNodeSetup(name, parameters.options, parameters.settings);
  LogInfo("pipeline " + setup.pipeline.name + ", rig " + setup.options.rig);
  const SlamNode node(std::move(setup), private_node);
  LogInfo("listening");
  ros::spin();
  return 0;
}

}  // namespace
}  // namespace regolith

int main(int argc, char** argv) {
  ros::init(argc, argv, "regolith");
  try {
    return regolith::RunNode();
  } catch (const regolith::InputError& error) {
    regolith::LogError(error.what());
    return regolith::kWrongInput;
  } catch (const std::exception& error) {
    regolith::LogError(error.what());
    return 1;
  }
}
