// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "regolith/sim/drive.h"
#include "regolith/sim/leg_search.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// The legs driven one after the other: rest, point turn to the first leg, drive, stop, point turn,
/// stop and so on, and rest at the end. A pose every `interval` s until `duration` s.
std::vector<PlanarPose> TimeDrive(const DriveOptions& options, uint64_t seed,
                                  const std::vector<LegCurve>& legs, double duration,
                                  double interval);

/// s that a point turn by `angle` rad takes; 0 where that is too little to be one.
double TurnDuration(const DriveOptions& options, double angle);

/// s that a leg of `length` m takes from rest to rest, waves of the speed left out.
double LegDuration(const DriveOptions& options, double length);

}  // namespace regolith
