// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/lio/range_jumps_options.h"
#include "regolith/sensor/lidar_scan.h"

namespace regolith {

/// Indices, ascending, of the points on neither side of a jump of the range along their ring. At a
/// jump a beam falls on two surfaces and tells a range between them, and what stands before hides
/// what lies behind: such points lie elsewhere for each place that they are seen from, and an
/// odometry that believes them goes too far. The points of a ring come in the order of the turn.
std::vector<uint32_t> PointsOffRangeJumps(const LidarScan& scan, const RangeJumpOptions& options);

}  // namespace regolith
