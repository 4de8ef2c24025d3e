// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/geometry/se3.h"
#include "regolith/sim/camera_simulator.h"
#include "regolith/sim/lamp.h"
#include "regolith/sim/rover_motion.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// How a camera moves with the body that carries it.
CameraMotion CameraMotionOf(const MotionState& motion, const SE3& T_imu_camera);

/// The headlight of a rover that stands at `T_world_base`.
Lamp LampOnRover(const ScenarioOptions& options, const SE3& T_world_base);

}  // namespace regolith
