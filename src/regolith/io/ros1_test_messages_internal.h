// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For tests: messages as the ROS libraries themselves serialize them.
#include <cstdint>
#include <vector>

#include <ros/serialization.h>

#include "regolith/io/ros1_conversions_internal.h"

namespace regolith {

template <typename Message>
std::vector<uint8_t> Serialize(const Message& message) {
  std::vector<uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

}  // namespace regolith
