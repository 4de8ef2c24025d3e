// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/ros/topic_input.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace regolith {
namespace {

constexpr double kRateWindow = 3.0;  // s
constexpr size_t kMostArrivals = 2000;

}  // namespace

TopicInput::TopicInput(SensorTopic sensor, const RigCalibration& rig)
    : sensor_(std::move(sensor)), rig_(rig), filter_(sensor_.topic, {}) {}

std::vector<std::string> TopicInput::Topics() const {
  std::vector<std::string> topics = {sensor_.topic};
  if (sensor_.IsCamera()) topics.push_back(sensor_.topic + "/compressed");
  return topics;
}

std::optional<SensorEvent> TopicInput::Receive(const std::string& type, MessageBytes bytes,
                                               double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Count(now);
  if (!sensor_.Fits(type)) {
    ++status_.dropped;
    status_.problem = "messages of type " + type + "; expected " + sensor_.types.front() + " for " +
                      sensor_.sensor;
    return std::nullopt;
  }
  if (type != sensor_.type) {
    sensor_.type = status_.type = type;
    decode_ = MakeDecoder(sensor_, rig_, sensor_.topic);
  }
  std::optional<SensorEvent> event;
  try {
    event = decode_(bytes, filter_);
    status_.problem.clear();
  } catch (const std::exception& error) {
    // Of whatever library: a message is no reason to end.
    status_.problem = error.what();
  }
  if (!event) ++status_.dropped;
  return event;
}

void TopicInput::Skip(double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Count(now);
  ++status_.dropped;
  filter_.CountDropped("came faster than they could be read");
}

void TopicInput::Count(double now) {
  ++status_.messages;
  arrivals_.push_back(now);
  if (arrivals_.size() > kMostArrivals) arrivals_.pop_front();
}

TopicStatus TopicInput::Status(double now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  TopicStatus status = status_;
  const auto recent = std::count_if(arrivals_.begin(), arrivals_.end(),
                                    [&](double arrival) { return arrival > now - kRateWindow; });
  status.rate = static_cast<double>(recent) / kRateWindow;
  if (!arrivals_.empty()) status.age = now - arrivals_.back();
  filter_.AppendNotices(&status.notices);
  return status;
}

}  // namespace regolith
