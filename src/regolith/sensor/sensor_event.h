// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "regolith/core/time.h"
#include "regolith/sensor/image.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/lidar_scan.h"
#include "regolith/sensor/wheel_odometry.h"

namespace regolith {

/// One measurement of one sensor.
using SensorEvent = std::variant<ImuSample, LidarScan, CameraFrame, WheelOdometry>;

/// The stamp of a measurement: a scan's is that of its first firing.
TimeNs EventTime(const SensorEvent& event);

/// The measurements of a recording or of a simulator in order of their stamps, one at a time:
/// memory does not grow with the length of the recording. Truth is never among them.
class SensorSource {
 public:
  virtual ~SensorSource() = default;

  /// The next measurement; nothing at the end.
  virtual std::optional<SensorEvent> Next() = 0;

  /// First and last stamp, for progress; both 0 where they are not known.
  virtual TimeNs start_time() const = 0;
  virtual TimeNs end_time() const = 0;

  /// What a user should know of the data so far, a line each: fields that were derived,
  /// measurements that were dropped and why, with counts.
  virtual std::vector<std::string> Notices() const = 0;
};

inline TimeNs EventTime(const SensorEvent& event) {
  struct Visitor {
    TimeNs operator()(const ImuSample& sample) const { return sample.time; }
    TimeNs operator()(const LidarScan& scan) const { return scan.stamp; }
    TimeNs operator()(const CameraFrame& frame) const { return frame.time; }
    TimeNs operator()(const WheelOdometry& odometry) const { return odometry.time; }
  };
  return std::visit(Visitor{}, event);
}

}  // namespace regolith
