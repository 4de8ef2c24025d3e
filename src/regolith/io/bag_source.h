// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "regolith/io/bag_reader.h"
#include "regolith/io/recording.h"

namespace regolith {

/// The measurements of a ROS 1 bag (OpenRecording, for files). Each message is read once, in the
/// order of the file, and held until nothing earlier can come.
std::unique_ptr<SensorSource> OpenBagSource(const std::string& path, const RigCalibration& rig,
                                            const ReadOptions& options);

/// What a sensor's topic is in a bag.
struct BagSensor {
  std::string sensor;              ///< "imu", "lidar", "wheels" or a camera's name
  std::string topic;               ///< as the rig says, or with /compressed behind it
  std::vector<std::string> types;  ///< message types that fit
  std::string type;                ///< the one found

  bool IsCamera() const { return types.size() > 1; }
};

/// The sensors of the rig, their topics not yet looked for.
std::vector<BagSensor> SensorsOf(const RigCalibration& rig);

/// Finds the topic of a sensor. Throws InputError that names the topics that would fit where it is
/// absent, and the type where that is another one.
BagSensor FindTopic(const BagReader& bag, BagSensor sensor);

}  // namespace regolith
