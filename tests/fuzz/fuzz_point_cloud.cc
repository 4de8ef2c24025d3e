// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdlib>

#include "regolith/io/point_cloud.h"

/// A scan that is passed on holds finite points within the calibrated range, at finite times.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace regolith;
  const LidarCalibration calibration;
  const PointCloudResult result = ParsePointCloud({data, size}, calibration);
  if (!result.scan) {
    if (result.problem.empty()) std::abort();
    return 0;
  }
  for (const LidarPoint& point : result.scan->points) {
    const double range = point.position.norm();
    if (!(range >= calibration.min_range && range <= calibration.max_range)) std::abort();
    if (!std::isfinite(point.time) || !std::isfinite(point.intensity)) std::abort();
  }
  return 0;
}
