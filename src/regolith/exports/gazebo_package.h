// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/exports/gazebo_world.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// terrain.sdf (the ground), world.sdf (the same with the rover on it) and the rover as a Gazebo
/// model in models/regolith_rover. heightmap.png and the texture must lie in `folder`. Throws
/// OutputError.
void WriteGazeboWorlds(const std::string& folder, const ScenarioOptions& options,
                       const WorldDescription& world);

/// Makes `folder` the catkin package regolith_world: rover.urdf.xacro, rover.urdf, launch files,
/// control, RViz's view. `has_world`: terrain.sdf is there; else the launch file starts Gazebo's
/// empty world. Throws OutputError.
void WriteRoverPackage(const std::string& folder, const ScenarioOptions& options,
                       const WorldDescription& world, bool has_world);

}  // namespace regolith
