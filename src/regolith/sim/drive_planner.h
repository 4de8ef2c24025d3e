// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "regolith/sim/drive.h"
#include "regolith/sim/scenario_options.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// Plans the route that `options` and `seed` ask for on the ground and drives it: a pose every
/// `interval` s from time 0 to `duration` s, yaw 0 at the first. A longer drive begins as the
/// shorter one; where the route ends before the duration, the rover rests at its end. Throws
/// InputError, saying what to do, where no route can be found.
Drive PlanDrive(const Surface& surface, const DriveOptions& options, const RoverOptions& rover,
                uint64_t seed, double duration, double interval);

}  // namespace regolith
