// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/exports/terrain_posts.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// What a world is made of; lengths in the frame of the exports, m.
struct WorldDescription {
  double ground_side = 1.0;  ///< m
  HeightRange range;         ///< m, of the height map's black and white
  Place start;               ///< where the rover is set down
  bool has_mesh = false;     ///< terrain.dae is there: it is what is seen
};

/// The image that height map and meshes are covered with.
inline constexpr const char* kTextureName = "terrain_texture.png";
inline constexpr const char* kRoverModel = "regolith_rover";

/// A Gazebo world (SDF 1.6): the ground, the planet's gravity, its sun and sky. `with_rover` puts
/// model://regolith_rover on it.
std::string GazeboWorld(const ScenarioOptions& options, const WorldDescription& world,
                        bool with_rover);

}  // namespace regolith
