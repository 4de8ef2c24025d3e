// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace regolith {

/// What a scan's point belongs to.
enum class PointLabel : uint8_t {
  kNone,     ///< unknown, or of a cluster too small to be met again
  kGround,   ///< what the rover stands on, and what continues it
  kCluster,  ///< of a thing that stands on the ground
};

/// One label a point of a scan, in the scan's order.
using PointLabels = std::vector<PointLabel>;

}  // namespace regolith
