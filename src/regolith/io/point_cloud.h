// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "regolith/io/ros1_messages.h"
#include "regolith/sensor/lidar_scan.h"
#include "regolith/sensor/rig_calibration.h"

namespace regolith {

/// What a user should know of how a cloud was read.
struct PointCloudFacts {
  size_t invalid_points = 0;  ///< dropped: not finite
  bool ring_derived = false;
  bool time_derived = false;
  bool time_missing = false;  ///< neither there nor derivable
  bool intensity_missing = false;
};

struct PointCloudResult {
  std::optional<LidarScan> scan;
  std::string problem;
  PointCloudFacts facts;
};

/// sensor_msgs/PointCloud2 with fields of any order, padding and type. Points that are not finite
/// are dropped and counted; points nearer or farther than the calibration allows are dropped. Times
/// may be seconds, milli-, micro- or nanoseconds from the stamp, or absolute (fields time, t,
/// timestamp, offset_time). A missing ring comes from the elevation within the fan of
/// `calibration`, missing times from the azimuth where the points lie in firing order. Refused: big
/// endian, sizes that do not agree, no x y z.
PointCloudResult ParsePointCloud(MessageBytes message, const LidarCalibration& calibration);

/// The same derivations for scans that come from elsewhere. Ring from elevation:
void DeriveRings(const LidarCalibration& calibration, LidarScan* scan);
/// Times from azimuth, the first point at 0; false (and all times 0) where the azimuth does not run
/// through one turn in order.
bool DeriveTimes(double period, LidarScan* scan);

}  // namespace regolith
