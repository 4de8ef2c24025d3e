// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/geometry/se3.h"
#include "regolith/sensor/imu_sample.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// A drive over open, rolling ground: 1.2 s at rest, then to 0.5 m/s along x. The lidar is the
/// body.
inline constexpr double kSyntheticGravity = 1.62;  // m/s²

/// T_world_body at `time` (s).
SE3 SyntheticPose(double time);
ImuSample SyntheticImu(double time);
/// About 13 000 returns with 1 cm of noise; the turn starts at 0.1 s · `index`.
const LidarScan& SyntheticScan(int index);
/// The positions of a scan (m, lidar frame).
std::vector<Eigen::Vector3d> Positions(const LidarScan& scan);
/// Positions of the first `scans` scans in the world, without motion distortion.
std::vector<Eigen::Vector3d> SyntheticMap(int scans);

}  // namespace regolith
