// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "regolith/core/span.h"
#include "regolith/geometry/se3.h"

namespace regolith {

/// A measured motion from one pose of a graph to another.
struct PoseGraphEdge {
  size_t from = 0;
  size_t to = 0;
  SE3 T_from_to;
  double rotation_sigma = 0.01;  ///< rad
  double position_sigma = 0.1;   ///< m
  bool robust = false;           ///< a measurement that may be wrong: its pull is bounded
};

/// The poses that agree best with the edges (least squares, by Ceres on one thread), the first of
/// them held. `guess`: T_map_i of each pose.
std::vector<SE3> OptimizePoseGraph(Span<const SE3> guess, Span<const PoseGraphEdge> edges);

}  // namespace regolith
