// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/exports/terrain_posts.h"

namespace regolith {

/// Whether a height map may have so many posts a side: Gazebo takes 2ⁿ + 1, from 17 to 8193.
bool IsHeightMapSize(int count);

/// The posts as a 16-bit grey PNG, north up: 0 is the lowest, 65535 the highest, linear between.
/// Returns the heights (m) that these two stand for. Throws OutputError.
HeightRange WriteHeightMap(const std::string& path, const TerrainPosts& posts);

}  // namespace regolith
