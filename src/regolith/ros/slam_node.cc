// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// regolith_node: a SLAM pipeline fed by the topics of a rover. It translates messages, nothing else
// (docs/ros.md).
#include <algorithm>
#include <cctype>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <topic_tools/shape_shifter.h>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/core/log.h"
#include "regolith/io/ply.h"
#include "regolith/io/tum.h"
#include "regolith/ros/node_main_internal.h"
#include "regolith/ros/node_setup.h"
#include "regolith/ros/ros_parameters_internal.h"
#include "regolith/ros/slam_outputs_internal.h"
#include "regolith/ros/topic_input.h"
#include "regolith/system/live_slam.h"

namespace regolith {
namespace {

constexpr uint32_t kMessageQueue = 5000;
constexpr size_t kMostUnread = 4;  // scans or images of a topic

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
    unread_count_.resize(inputs_.size());
    reader_ = std::thread([this] { ReadLarge(); });
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

  ~SlamNode() {
    for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
    {
      const std::lock_guard<std::mutex> lock(unread_mutex_);
      stop_ = true;
    }
    unread_wake_.notify_all();
    reader_.join();
  }
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

 private:
  void Subscribe(size_t input) {
    for (const std::string& topic : inputs_[input].Topics()) {
      subscribers_.push_back(private_node_.subscribe<topic_tools::ShapeShifter>(
          topic, kMessageQueue, [this, input](const topic_tools::ShapeShifter::ConstPtr& message) {
            Receive(input, message);
          }));
    }
  }

  /// What takes time to read goes to a thread of its own, so that the IMU need not wait.
  void Receive(size_t input, const topic_tools::ShapeShifter::ConstPtr& message) {
    const std::string& sensor = inputs_[input].name();
    if (sensor == "imu" || sensor == "wheels") return Read(input, *message, &buffer_);
    const std::lock_guard<std::mutex> lock(unread_mutex_);
    if (unread_count_[input] >= kMostUnread) {
      const auto oldest = std::find_if(unread_.begin(), unread_.end(),
                                       [&](const auto& entry) { return entry.first == input; });
      unread_.erase(oldest);
      --unread_count_[input];
      inputs_[input].Skip(SteadySeconds());
    }
    unread_.emplace_back(input, message);
    ++unread_count_[input];
    unread_wake_.notify_one();
  }

  void ReadLarge() {
    std::vector<uint8_t> buffer;
    std::unique_lock<std::mutex> lock(unread_mutex_);
    while (true) {
      unread_wake_.wait(lock, [this] { return stop_ || !unread_.empty(); });
      if (stop_) return;
      const auto [input, message] = unread_.front();
      unread_.pop_front();
      --unread_count_[input];
      lock.unlock();
      Read(input, *message, &buffer);
      lock.lock();
    }
  }

  void Read(size_t input, const topic_tools::ShapeShifter& message, std::vector<uint8_t>* buffer) {
    buffer->resize(message.size());
    ros::serialization::OStream stream(buffer->data(), message.size());
    message.write(stream);
    auto event = inputs_[input].Receive(message.getDataType(), *buffer, SteadySeconds());
    if (!event) return;
    const auto* const sample = std::get_if<ImuSample>(&*event);
    const std::optional<ImuSample> imu = sample != nullptr ? std::optional(*sample) : std::nullopt;
    live_.Push(input, std::move(*event));
    if (imu) PublishPrediction(*imu);
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
      const TopicStatus status = inputs_[i].Status(now);
      message.status.push_back(
          TopicDiagnostics(node, inputs_[i], status, live_.dropped(i), setup_.options.silence,
                           status.messages == 0 ? OtherTopics(inputs_[i]) : std::string()));
    }
    diagnostics_.publish(message);
    for (const auto& status : message.status) Tell(status);
  }

  /// Topics with messages that a sensor could use, each with a space before it.
  static std::string OtherTopics(const TopicInput& input) {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    std::string others;
    for (const ros::master::TopicInfo& topic : topics) {
      const auto& types = input.types();
      const bool fits = std::find(types.begin(), types.end(), topic.datatype) != types.end();
      const bool is_own = topic.name.rfind(ros::this_node::getName() + "/", 0) == 0;
      if (fits && !is_own) others += " " + topic.name;
    }
    return others;
  }

  /// Whoever watches the terminal alone sees each trouble once, whatever the numbers in it.
  void Tell(const diagnostic_msgs::DiagnosticStatus& status) {
    std::string kind(1, static_cast<char>(status.level));
    if (status.level != diagnostic_msgs::DiagnosticStatus::OK) {
      for (const char letter : status.message) {
        if (std::isdigit(static_cast<unsigned char>(letter)) == 0 && letter != '.') kind += letter;
      }
    }
    if (std::exchange(told_[status.name], kind) == kind) return;
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
  std::deque<TopicInput> inputs_;
  std::vector<uint8_t> buffer_;  ///< of the callbacks' thread
  std::mutex unread_mutex_;
  std::condition_variable unread_wake_;
  std::deque<std::pair<size_t, topic_tools::ShapeShifter::ConstPtr>> unread_;
  std::vector<size_t> unread_count_;  ///< by input
  bool stop_ = false;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Publisher diagnostics_;
  ros::WallTimer timer_;
  std::map<std::string, std::string> told_;
  size_t dropped_before_ = 0;
  LiveSlam live_;
  std::thread reader_;
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
  return regolith::NodeMain(argc, argv, "regolith", regolith::RunNode);
}
