// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/recording_info.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/bag_source.h"
#include "regolith/io/point_cloud.h"
#include "regolith/io/ros1_messages.h"

namespace regolith {
namespace {

constexpr double kRestSeconds = 2.0;
constexpr size_t kCloudStride = 10;
constexpr double kStandardGravity = 9.80665;  // m/s² in one g
constexpr double kGravityTolerance = 0.2;     // relative; rovers tilt, accelerometers have biases
constexpr double kRateTolerance = 0.2;        // relative

bool HasHeader(const std::string& type) {
  return type.rfind("sensor_msgs/", 0) == 0 || type == "nav_msgs/Odometry" ||
         (type.rfind("geometry_msgs/", 0) == 0 && type.find("Stamped") != std::string::npos);
}

/// Gathers what TopicInfo says, message by message.
class TopicCollector {
 public:
  TopicCollector(std::string name, std::string type) {
    info_.name = std::move(name);
    info_.type = std::move(type);
  }

  void AddStamp(TimeNs stamp) {
    if (info_.messages == 0) first_ = last_ = newest_ = stamp;
    if (info_.messages > 0) {
      info_.repeated += stamp == last_ ? 1 : 0;
      info_.backward += stamp < last_ ? 1 : 0;
      info_.largest_gap = std::max(info_.largest_gap, SecondsBetween(newest_, stamp));
    }
    last_ = stamp;
    newest_ = std::max(newest_, stamp);
    ++info_.messages;
  }

  void AddImu(const ImuSample& sample) {
    if (SecondsBetween(first_, sample.time) > kRestSeconds) return;
    force_sum_ += sample.specific_force.norm();
    ++force_count_;
  }

  void AddImage(const Image& image, const std::string& encoding) {
    info_.width = image.width;
    info_.height = image.height;
    Remark(Concatenate(image.width, " x ", image.height, " ", encoding));
  }

  void AddCloud(const PointCloudResult& result) {
    if (result.facts.ring_derived) Remark("no ring");
    if (result.facts.time_derived) Remark("no time (derivable from azimuth)");
    if (result.facts.time_missing) Remark("no time");
    if (result.facts.intensity_missing) Remark("no intensity");
    ++sampled_clouds_;
    invalid_points_ += result.facts.invalid_points;
  }

  void AddProblem(const std::string& problem) { ++problems_[problem]; }

  void Remark(const std::string& remark) {
    auto& remarks = info_.remarks;
    if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) {
      remarks.push_back(remark);
    }
  }

  TimeNs first() const { return first_; }
  TimeNs newest() const { return newest_; }

  TopicInfo Finish() const {
    TopicInfo info = info_;
    info.duration = SecondsBetween(first_, newest_);
    if (info.messages > 1 && info.duration > 0.0) {
      info.rate = static_cast<double>(info.messages - 1) / info.duration;
    }
    if (force_count_ > 0) info.rest_force = force_sum_ / static_cast<double>(force_count_);
    if (invalid_points_ > 0) {
      info.remarks.push_back(Concatenate(invalid_points_, " points not finite in ", sampled_clouds_,
                                         " clouds sampled"));
    }
    for (const auto& [problem, count] : problems_) {
      info.remarks.push_back(Concatenate(count, " unusable: ", problem));
    }
    return info;
  }

 private:
  TopicInfo info_;
  TimeNs first_ = 0;
  TimeNs last_ = 0;
  TimeNs newest_ = 0;
  double force_sum_ = 0.0;
  size_t force_count_ = 0;
  size_t sampled_clouds_ = 0;
  size_t invalid_points_ = 0;
  std::map<std::string, size_t> problems_;
};

void InspectMessage(const std::string& type, MessageBytes bytes, size_t index,
                    TopicCollector* topic) {
  if (type == "sensor_msgs/Imu") {
    const auto result = ParseImu(bytes);
    if (result.value) topic->AddImu(*result.value);
    if (!result.value) topic->AddProblem(result.problem);
  } else if (type == "sensor_msgs/PointCloud2" && index % kCloudStride == 0) {
    const auto result = ParsePointCloud(bytes, LidarCalibration());
    if (result.scan) topic->AddCloud(result);
    if (!result.scan) topic->AddProblem(result.problem);
  } else if (index == 0 && (type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage")) {
    const bool compressed = type == "sensor_msgs/CompressedImage";
    const auto result = compressed ? ParseCompressedImage(bytes) : ParseImage(bytes);
    if (result.value) topic->AddImage(result.value->image, ImageEncoding(bytes, compressed));
    if (!result.value) topic->AddProblem(result.problem);
  }
}

using Collectors = std::map<std::pair<std::string, std::string>, std::pair<TopicCollector, size_t>>;

RecordingInfo Summarise(const Collectors& collectors) {
  RecordingInfo info;
  TimeNs first = std::numeric_limits<TimeNs>::max();
  TimeNs last = std::numeric_limits<TimeNs>::min();
  for (const auto& [key, collector] : collectors) {
    info.topics.push_back(collector.first.Finish());
    first = std::min(first, collector.first.first());
    last = std::max(last, collector.first.newest());
  }
  info.duration = collectors.empty() ? 0.0 : SecondsBetween(first, last);
  return info;
}

TopicCollector& Collector(Collectors* collectors, const std::string& name, const std::string& type,
                          size_t* index) {
  const std::pair<std::string, std::string> key(name, type);
  auto found = collectors->find(key);
  if (found == collectors->end()) {
    found = collectors->emplace(key, std::make_pair(TopicCollector(name, type), size_t{0})).first;
  }
  *index = found->second.second++;
  return found->second.first;
}

RecordingInfo InspectBag(const std::string& path) {
  const auto bag = BagReader::Open(path);
  Collectors collectors;
  for (const auto cursor = bag->Cursor(""); !cursor->Done(); cursor->Advance()) {
    const std::string type = cursor->type();
    size_t index = 0;
    TopicCollector& topic = Collector(&collectors, cursor->topic(), type, &index);
    const MessageBytes bytes = cursor->Read();
    const auto stamp = HasHeader(type) ? HeaderStamp(bytes) : std::nullopt;
    if (!HasHeader(type)) topic.Remark("no header: record times");
    topic.AddStamp(stamp.value_or(cursor->record_time()));
    InspectMessage(type, bytes, index, &topic);
  }
  return Summarise(collectors);
}

void InspectEvent(const SensorEvent& event, Collectors* collectors) {
  size_t index = 0;
  if (const auto* sample = std::get_if<ImuSample>(&event)) {
    TopicCollector& topic = Collector(collectors, "imu", "IMU", &index);
    topic.AddStamp(sample->time);
    topic.AddImu(*sample);
  } else if (const auto* scan = std::get_if<LidarScan>(&event)) {
    TopicCollector& topic = Collector(collectors, "lidar", "scans", &index);
    topic.AddStamp(scan->stamp);
    if (!scan->has_point_times) topic.Remark("no time");
  } else if (const auto* frame = std::get_if<CameraFrame>(&event)) {
    TopicCollector& topic = Collector(collectors, frame->camera, "images", &index);
    topic.AddStamp(frame->time);
    if (index == 0) topic.AddImage(frame->image, "grey");
  }
}

RecordingInfo InspectFolder(const RecordingIdentity& identity) {
  RigCalibration rig;
  ApplyFolderCalibration(identity, &rig);
  ReadOptions options;
  for (const auto& [name, camera] : rig.cameras) options.cameras.push_back(name);
  const auto source = OpenRecording(identity, rig, options);
  Collectors collectors;
  while (const auto event = source->Next()) InspectEvent(*event, &collectors);
  RecordingInfo info = Summarise(collectors);
  info.notices = source->Notices();
  return info;
}

const TopicInfo* Find(const RecordingInfo& info, const std::string& name) {
  const auto found = std::find_if(info.topics.begin(), info.topics.end(),
                                  [&](const TopicInfo& topic) { return topic.name == name; });
  return found == info.topics.end() ? nullptr : &*found;
}

void CheckImu(const TopicInfo& topic, const RigCalibration& rig,
              std::vector<std::string>* problems) {
  if (topic.rate > 0.0 && std::abs(topic.rate / rig.imu->rate - 1.0) > kRateTolerance) {
    problems->push_back(Concatenate(topic.name, ": ", topic.rate, " Hz; the rig's imu.rate is ",
                                    rig.imu->rate, " Hz"));
  }
  const double ratio = topic.rest_force / rig.gravity;
  if (topic.rest_force <= 0.0 || std::abs(ratio - 1.0) <= kGravityTolerance) return;
  const std::string measured =
      Concatenate(topic.name, ": mean specific force of the first ", kRestSeconds, " s is ",
                  topic.rest_force, ", the rig's gravity ", rig.gravity, " m/s^2");
  const bool in_g = std::abs(ratio * kStandardGravity - 1.0) <= kGravityTolerance;
  problems->push_back(measured + (in_g ? ": looks like g, not m/s^2; multiply by 9.80665"
                                       : ": check `gravity` and the unit"));
}

void CheckCamera(const TopicInfo& topic, const std::string& name, const CameraCalibration& camera,
                 std::vector<std::string>* problems) {
  const CameraIntrinsics& intrinsics = camera.intrinsics;
  if (topic.width == 0 || (topic.width == intrinsics.width && topic.height == intrinsics.height)) {
    return;
  }
  problems->push_back(Concatenate(topic.name, ": images of ", topic.width, " x ", topic.height,
                                  " pixels; the rig's camera '", name, "' has ", intrinsics.width,
                                  " x ", intrinsics.height));
}

bool IsBag(const RecordingIdentity& identity) {
  return identity.format == RecordingFormat::kRosBag ||
         identity.format == RecordingFormat::kSimulated;
}

}  // namespace

RecordingInfo InspectRecording(const RecordingIdentity& identity) {
  RecordingInfo info = IsBag(identity) ? InspectBag(identity.data_path) : InspectFolder(identity);
  info.format = RecordingFormatName(identity.format);
  return info;
}

std::vector<std::string> CheckRigFits(const RecordingIdentity& identity, const RecordingInfo& info,
                                      const RigCalibration& rig) {
  std::vector<std::string> problems;
  const auto bag = IsBag(identity) ? BagReader::Open(identity.data_path) : nullptr;
  for (const SensorTopic& sensor : SensorsOf(rig)) {
    const TopicInfo* topic = Find(info, sensor.sensor);
    if (bag != nullptr) {
      try {
        topic = Find(info, FindTopic(*bag, sensor).topic);
      } catch (const InputError& error) {
        problems.emplace_back(error.what());
        continue;
      }
    }
    if (topic == nullptr) {
      problems.push_back(sensor.sensor + ": the recording has no such sensor");
      continue;
    }
    if (sensor.sensor == "imu") CheckImu(*topic, rig, &problems);
    const auto camera = rig.cameras.find(sensor.sensor);
    if (camera != rig.cameras.end()) CheckCamera(*topic, camera->first, camera->second, &problems);
  }
  return problems;
}

}  // namespace regolith
