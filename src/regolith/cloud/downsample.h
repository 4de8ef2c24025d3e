// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"

namespace regolith {

/// Indices, ascending, of the first point in each cubic voxel of edge `voxel_size` (m).
std::vector<uint32_t> DownsampleIndices(Span<const Eigen::Vector3d> points, double voxel_size);

}  // namespace regolith
