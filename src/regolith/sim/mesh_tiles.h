// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "regolith/core/span.h"
#include "regolith/core/thread_pool.h"
#include "regolith/sim/ground.h"
#include "regolith/sim/scenario_options.h"

namespace regolith {

/// A square of posts. Rows run along y, columns along x, both upwards.
struct MeshTile {
  uint32_t first_post = 0;
  int posts = 0;  ///< along a side
  float spacing = 0.0F;
};

/// The posts of a terrain mesh, ready for rays.
struct MeshTiles {
  static constexpr double kTileSize = 3.2;  ///< m; a multiple of every spacing

  struct Shape {
    float slope_x = 0.0F;
    float slope_y = 0.0F;
    float albedo = 0.0F;
    float sunlit = 1.0F;
  };

  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< m, of the first tile
  int columns = 0;
  int rows = 0;
  std::vector<MeshTile> tiles;
  std::vector<Eigen::Vector3f> positions;  ///< m, world; one float more allocated for Embree
  std::vector<Shape> shapes;

  const MeshTile& TileAt(int column, int row) const {
    return tiles[static_cast<size_t>(row) * static_cast<size_t>(columns) +
                 static_cast<size_t>(column)];
  }
};

/// Lays tiles over the path and its surroundings and samples the ground at their posts.
MeshTiles BuildMeshTiles(const Ground& ground, Span<const Eigen::Vector2d> path,
                         const MeshOptions& options, ThreadPool* pool);

}  // namespace regolith
