// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/sim/planar_path.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// A place on a surface where a path can be driven.
struct Patch {
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< m, of the path's start
  double steepest = 0.0;                             ///< rad, on the path
};

/// Looks through seeded places for one where the ground around the whole path is known and no slope
/// on it exceeds `max_slope` (rad); prefers paths that have some slope of at least 10 degrees.
/// Throws InputError where there is none, saying why.
Patch FindPatch(const Surface& surface, Span<const PlanarPose> path, double max_slope,
                uint64_t seed);

}  // namespace regolith
