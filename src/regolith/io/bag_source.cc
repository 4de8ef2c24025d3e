// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/io/bag_source.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <utility>

#include "regolith/core/check.h"
#include "regolith/core/error.h"
#include "regolith/io/message_decoder.h"
#include "regolith/io/ros1_messages.h"
#include "regolith/io/topic_filter.h"

namespace regolith {
namespace {

/// How much a topic's delay between stamp and recording may vary from one message to the next. The
/// bag is read this far ahead.
constexpr double kDelayVariation = 0.5;  // s

/// One topic that is being read.
struct Stream {
  std::unique_ptr<BagCursor> cursor;
  MessageDecoder decode;
  TopicFilter filter;
  std::deque<SensorEvent> waiting;
  double time_offset = 0.0;  ///< s, added to its stamps
  /// Record time minus time of the last message; tells when the next one is to be expected.
  TimeNs delay = 0;
};

bool IsWanted(const std::string& sensor, const ReadOptions& options) {
  if (sensor == "imu") return options.imu;
  if (sensor == "lidar") return options.lidar;
  if (sensor == "wheels") return options.wheels;
  return std::find(options.cameras.begin(), options.cameras.end(), sensor) != options.cameras.end();
}

/// Name of the sensor's topic in the bag; an image's may be compressed.
auto FindName(const std::vector<BagTopic>& topics, const SensorTopic& sensor) {
  const auto find = [&](const std::string& name) {
    return std::find_if(topics.begin(), topics.end(),
                        [&](const BagTopic& topic) { return topic.name == name; });
  };
  const auto found = find(sensor.topic);
  return found == topics.end() && sensor.IsCamera() ? find(sensor.topic + "/compressed") : found;
}

class BagSource : public SensorSource {
 public:
  BagSource(const std::string& path, const RigCalibration& rig, const ReadOptions& options)
      : bag_(BagReader::Open(path)) {
    CheckCuts(options.cuts, rig);
    for (const SensorTopic& sensor : SensorsOf(rig)) {
      if (!IsWanted(sensor.sensor, options)) continue;
      const bool may_lack = sensor.IsCamera()
                                ? options.skip_absent_cameras
                                : sensor.sensor == "wheels" && options.skip_absent_wheels;
      if (may_lack && FindName(bag_->topics(), sensor) == bag_->topics().end()) {
        const std::string what =
            sensor.IsCamera() ? "images of camera " + sensor.sensor : sensor.sensor;
        notices_.push_back("no " + what + ": " + path + " has no topic " + sensor.topic);
        continue;
      }
      AddStream(FindTopic(*bag_, sensor), rig, options.cuts);
    }
    FindStart(rig);
  }

  std::optional<SensorEvent> Next() override {
    while (true) {
      Stream* const first = EarliestWaiting();
      if (first != nullptr && !IsSomethingEarlierExpected(EventTime(first->waiting.front()))) {
        return Pop(first);
      }
      Stream* const unread = EarliestUnread();
      if (unread == nullptr) {
        if (first == nullptr) return std::nullopt;
        return Pop(first);
      }
      ReadOne(unread);
    }
  }

  TimeNs start_time() const override { return start_; }
  TimeNs end_time() const override { return end_; }

  std::vector<std::string> Notices() const override {
    std::vector<std::string> notices = notices_;
    for (const auto& stream : streams_) stream->filter.AppendNotices(&notices);
    return notices;
  }

 private:
  void AddStream(const SensorTopic& sensor, const RigCalibration& rig,
                 const std::vector<TopicCut>& cuts) {
    // A rig may name one topic with /compressed at its end or without; cuts name it as the rig
    // does.
    auto stream = std::unique_ptr<Stream>(
        new Stream{bag_->Cursor(sensor.topic),
                   MakeDecoder(sensor, rig, bag_->path() + ": " + sensor.topic),
                   TopicFilter(sensor.topic, CutsOf(cuts, TopicInRig(sensor, rig), sensor.sensor)),
                   {},
                   TimeOffset(sensor.sensor, rig),
                   0});
    streams_.push_back(std::move(stream));
  }

  static void SetDelay(Stream* stream, TimeNs record_time, TimeNs stamp) {
    stream->delay = record_time - AddSeconds(stamp, stream->time_offset);
  }

  static double TimeOffset(const std::string& sensor, const RigCalibration& rig) {
    if (sensor == "lidar") return rig.lidar->time_offset;
    const auto camera = rig.cameras.find(sensor);
    return camera == rig.cameras.end() ? 0.0 : camera->second.time_offset;
  }

  static std::string TopicInRig(const SensorTopic& sensor, const RigCalibration& rig) {
    for (const SensorTopic& named : SensorsOf(rig)) {
      if (named.sensor == sensor.sensor) return named.topic;
    }
    return sensor.topic;
  }

  /// The first stamp of the rig's topics, read or not, so that cuts do not move with what is read.
  void FindStart(const RigCalibration& rig) {
    start_ = std::numeric_limits<TimeNs>::max();
    for (const SensorTopic& sensor : SensorsOf(rig)) {
      const auto cursor = bag_->Cursor(sensor.topic);
      if (cursor->Done()) continue;
      if (const auto stamp = HeaderStamp(cursor->Read())) start_ = std::min(start_, *stamp);
    }
    TimeNs delay = std::numeric_limits<TimeNs>::min();
    for (const auto& stream : streams_) {
      const auto stamp = HeaderStamp(stream->cursor->Read());
      if (stamp) SetDelay(stream.get(), stream->cursor->record_time(), *stamp);
      delay = std::max(delay, stream->delay);
      if (stamp) start_ = std::min(start_, *stamp);
    }
    if (streams_.empty() || start_ == std::numeric_limits<TimeNs>::max()) {
      start_ = end_ = 0;
      return;
    }
    end_ = std::max(start_, bag_->last_record_time() - delay);
  }

  Stream* EarliestWaiting() const {
    Stream* earliest = nullptr;
    for (const auto& stream : streams_) {
      if (stream->waiting.empty()) continue;
      if (earliest == nullptr ||
          EventTime(stream->waiting.front()) < EventTime(earliest->waiting.front())) {
        earliest = stream.get();
      }
    }
    return earliest;
  }

  bool IsSomethingEarlierExpected(TimeNs stamp) const {
    const TimeNs horizon = AddSeconds(stamp, kDelayVariation);
    return std::any_of(streams_.begin(), streams_.end(), [&](const auto& stream) {
      return stream->waiting.empty() && !stream->cursor->Done() &&
             stream->cursor->record_time() - stream->delay <= horizon;
    });
  }

  Stream* EarliestUnread() const {
    Stream* earliest = nullptr;
    for (const auto& stream : streams_) {
      if (stream->cursor->Done()) continue;
      if (earliest == nullptr || stream->cursor->record_time() < earliest->cursor->record_time()) {
        earliest = stream.get();
      }
    }
    return earliest;
  }

  void ReadOne(Stream* stream) const {
    const TimeNs record_time = stream->cursor->record_time();
    const MessageBytes bytes = stream->cursor->Read();
    if (const auto stamp = HeaderStamp(bytes)) SetDelay(stream, record_time, *stamp);
    auto event = stream->decode(bytes, stream->filter);
    stream->cursor->Advance();
    if (!event || !stream->filter.Accept(EventTime(*event), start_)) return;
    if (passed_on_ && EventTime(*event) < *passed_on_) {
      stream->filter.CountDropped("recorded too long after its stamp to be put in order");
      return;
    }
    stream->waiting.push_back(std::move(*event));
  }

  std::optional<SensorEvent> Pop(Stream* stream) {
    SensorEvent event = std::move(stream->waiting.front());
    stream->waiting.pop_front();
    passed_on_ = EventTime(event);
    return event;
  }

  std::unique_ptr<BagReader> bag_;
  std::vector<std::unique_ptr<Stream>> streams_;
  std::vector<std::string> notices_;
  std::optional<TimeNs> passed_on_;
  TimeNs start_ = 0;
  TimeNs end_ = 0;
};

}  // namespace

std::unique_ptr<SensorSource> OpenBagSource(const std::string& path, const RigCalibration& rig,
                                            const ReadOptions& options) {
  return std::make_unique<BagSource>(path, rig, options);
}

SensorTopic FindTopic(const BagReader& bag, SensorTopic sensor) {
  const auto& topics = bag.topics();
  const auto found = FindName(topics, sensor);
  if (found == topics.end()) {
    std::string others;
    for (const BagTopic& topic : topics) {
      if (sensor.Fits(topic.type)) others += " " + topic.name;
    }
    throw InputError(bag.path(), "has no topic " + sensor.topic + " (" + sensor.types.front() +
                                     ", for " + sensor.sensor + "); " +
                                     (others.empty() ? "no topic of that type is in it"
                                                     : "the rig could name one of:" + others));
  }
  for (auto topic = found; topic != topics.end() && topic->name == found->name; ++topic) {
    if (!sensor.Fits(topic->type)) {
      throw InputError(bag.path(), "topic " + topic->name + " is of type " + topic->type +
                                       "; expected " + sensor.types.front() + " for " +
                                       sensor.sensor);
    }
  }
  sensor.topic = found->name;
  sensor.type = found->type;
  return sensor;
}

}  // namespace regolith
