// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regolith/io/ros1_messages.h"
#include "regolith/io/topic_filter.h"
#include "regolith/sensor/rig_calibration.h"
#include "regolith/sensor/sensor_event.h"

namespace regolith {

/// The topic of a sensor, in a bag or live.
struct SensorTopic {
  std::string sensor;              ///< "imu", "lidar", "wheels" or a camera's name
  std::string topic;               ///< as the rig says, or with /compressed behind it
  std::vector<std::string> types;  ///< message types that fit
  std::string type;                ///< the one found

  bool IsCamera() const { return types.size() > 1; }
  bool Fits(const std::string& message_type) const;
};

/// The sensors of the rig, their topics not yet looked for.
std::vector<SensorTopic> SensorsOf(const RigCalibration& rig);

/// Makes a measurement of a message, on the IMU's clock. What cannot be used is counted in the
/// filter, and what had to be derived is noted there. Throws InputError for an image of another
/// size than the rig says.
using MessageDecoder = std::function<std::optional<SensorEvent>(MessageBytes, TopicFilter&)>;

/// The decoder of a topic whose type has been found. `where`: the topic, for errors.
MessageDecoder MakeDecoder(const SensorTopic& sensor, const RigCalibration& rig,
                           const std::string& where);

}  // namespace regolith
