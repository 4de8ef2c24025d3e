// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace regolith {

/// A lidar return in the frame of a map.
struct MapPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m
  float intensity = 0.0F;
};

}  // namespace regolith
