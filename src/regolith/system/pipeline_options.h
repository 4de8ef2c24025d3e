// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/lio/lidar_odometry_options.h"
#include "regolith/system/map_builder.h"

namespace regolith {

/// One pipeline: which subsystems run, and how.
struct PipelineOptions {
  std::string name;
  LidarOdometryOptions lio;
  MapBuilderOptions map;
};

}  // namespace regolith
