// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "regolith/io/message_decoder.h"

namespace regolith {

/// How a topic does.
struct TopicStatus {
  size_t messages = 0;               ///< received
  size_t dropped = 0;                ///< of them, that could not be read
  double rate = 0.0;                 ///< Hz, by the clock, over the last seconds
  std::optional<double> age;         ///< s since the last one, by the clock
  std::string type;                  ///< of the messages
  std::string problem;               ///< why none can be read; empty where they can
  std::vector<std::string> notices;  ///< what was dropped and why, what had to be derived
};

/// One sensor's topic as it comes live: reads messages as those of a bag are read, counts those
/// that cannot be, and never throws for what is in them. One thread may receive while others ask.
class TopicInput {
 public:
  TopicInput(SensorTopic sensor, const RigCalibration& rig);

  /// The topics to listen to: an image's may be compressed and have a name of its own.
  std::vector<std::string> Topics() const;

  /// `now` in s, of a clock that never runs backward.
  std::optional<SensorEvent> Receive(const std::string& type, MessageBytes bytes, double now);

  /// A message that came faster than the ones before it could be read.
  void Skip(double now);

  const std::string& name() const { return sensor_.sensor; }
  const std::string& topic() const { return sensor_.topic; }
  const std::vector<std::string>& types() const { return sensor_.types; }
  TopicStatus Status(double now) const;

 private:
  void Count(double now);

  SensorTopic sensor_;  ///< but for the type that is found, as it was given
  RigCalibration rig_;
  mutable std::mutex mutex_;
  TopicFilter filter_;
  MessageDecoder decode_;
  TopicStatus status_;
  std::deque<double> arrivals_;  ///< s, of the last ones
};

}  // namespace regolith
