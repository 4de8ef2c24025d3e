// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/geometry/trajectory.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// The scan's points (m) as the body at `reference` would have seen them at once: each is moved by
/// the body's motion between its own time and the reference time. `motion` are poses of the body in
/// any fixed frame at increasing times; points outside their span take the nearest pose. Points
/// keep their order.
std::vector<Eigen::Vector3d> Deskew(const LidarScan& scan, const SE3& T_body_lidar,
                                    Span<const StampedPose> motion, const SE3& T_fixed_reference);

/// First and last point time of a scan (ns); its stamp twice where it is empty.
struct ScanInterval {
  TimeNs begin = 0;
  TimeNs end = 0;
};
ScanInterval IntervalOf(const LidarScan& scan);

}  // namespace regolith
