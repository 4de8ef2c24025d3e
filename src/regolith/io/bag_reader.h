// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "regolith/io/ros1_messages.h"

namespace regolith {

/// Throws InputError unless the file begins as a ROS 1 bag: absent, empty, of ROS 2, something
/// else.
void CheckBagFile(const std::string& path);

/// Throws InputError with the command that makes a ROS 1 bag of a ROS 2 recording: a folder, or an
/// .mcap or .db3 file.
[[noreturn]] void RefuseRos2(const std::string& path);

struct BagTopic {
  std::string name;
  std::string type;  ///< such as "sensor_msgs/Imu"
  size_t messages = 0;
};

/// Steps through messages of a bag in the order of their record times. Bytes are read only when
/// they are asked for. Damage met on the way throws InputError.
class BagCursor {
 public:
  virtual ~BagCursor() = default;
  virtual bool Done() const = 0;
  virtual TimeNs record_time() const = 0;
  virtual std::string topic() const = 0;
  virtual std::string type() const = 0;
  /// The message; valid until the next call of any cursor of the same bag.
  virtual MessageBytes Read() = 0;
  virtual void Advance() = 0;
};

/// A ROS 1 bag, compressed or not. Only its index is held in memory (about 70 bytes a message).
class BagReader {
 public:
  /// Throws InputError for a file that is absent, empty, no bag, truncated, or without messages.
  static std::unique_ptr<BagReader> Open(const std::string& path);
  virtual ~BagReader() = default;

  virtual const std::string& path() const = 0;
  /// By name; a topic with messages of two types stands here twice.
  virtual const std::vector<BagTopic>& topics() const = 0;
  virtual TimeNs first_record_time() const = 0;
  virtual TimeNs last_record_time() const = 0;
  /// Over one topic, or over all for an empty name. The bag must outlive it.
  virtual std::unique_ptr<BagCursor> Cursor(const std::string& topic) = 0;
};

}  // namespace regolith
