// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/time.h"

namespace regolith {

struct LidarPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< lidar frame at the point's own time, m
  float intensity = 0.0F;
  float time = 0.0F;  ///< s from the scan's stamp, whatever the sign
  uint16_t ring = 0;  ///< 0 is the lowest ring
};

/// The returns of one turn. A point's time is stamp + point.time.
struct LidarScan {
  TimeNs stamp = 0;
  std::vector<LidarPoint> points;
  /// False where the recording has no firing times and none could be derived: all times are 0 then.
  bool has_point_times = true;
};

}  // namespace regolith
