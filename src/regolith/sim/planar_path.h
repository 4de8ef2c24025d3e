// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/sim/scenario_options.h"

namespace regolith {

/// Where the rover's base is on the plane, as planned.
struct PlanarPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double yaw = 0.0;                                    ///< rad, unwrapped
  double speed = 0.0;                                  ///< m/s, along the heading
};

/// The drive on the plane, from the origin at yaw 0: a pose every `interval` s from time 0 to
/// `duration` s. A longer drive begins as the shorter one.
std::vector<PlanarPose> PlanPath(const DriveOptions& options, uint64_t seed, double duration,
                                 double interval);

}  // namespace regolith
