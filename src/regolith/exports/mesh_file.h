// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "regolith/exports/terrain_posts.h"

namespace regolith {

/// The posts as a textured mesh: a vertex a post with its normal and texture coordinates, two
/// triangles a cell, seen from above counter-clockwise. Heights are written to 0.1 mm. `texture`
/// names the image, which lies beside the mesh. Both throw OutputError.

/// COLLADA 1.4.1, z up, metres.
void WriteCollada(const std::string& path, const TerrainPosts& posts, const std::string& texture);

/// Wavefront OBJ, z up, metres, and beside it the material NAME.mtl.
void WriteObj(const std::string& path, const TerrainPosts& posts, const std::string& texture);

}  // namespace regolith
