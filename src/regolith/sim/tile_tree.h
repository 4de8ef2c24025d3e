// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/core/span.h"
#include "regolith/sim/mesh_options.h"

namespace regolith {

/// A square of ground, one of a tree in which each square of level n holds four of level n - 1.
/// Level 0 has the finest spacing.
struct TileKey {
  int level = 0;
  int column = 0;
  int row = 0;

  bool operator==(const TileKey& other) const {
    return level == other.level && column == other.column && row == other.row;
  }
  bool operator<(const TileKey& other) const {
    if (level != other.level) return level < other.level;
    if (row != other.row) return row < other.row;
    return column < other.column;
  }
};

/// Cells along a side of a tile.
inline constexpr int kTileCells = 128;

/// Which tiles cover the ground, fine where the rover drives and where it is, coarse elsewhere.
class TileTree {
 public:
  /// `path`: places of the rover in the plane (m, world).
  TileTree(const MeshOptions& options, Span<const Eigen::Vector2d> path);

  /// The tiles for a rover at `position` (m, world), sorted; they cover the whole ground once.
  std::vector<TileKey> Wanted(const Eigen::Vector2d& position) const;

  /// Posts of a level are so far apart, m.
  double Spacing(int level) const;
  double Size(int level) const { return kTileCells * Spacing(level); }
  Eigen::Vector2d Corner(const TileKey& key) const;

 private:
  void Divide(const TileKey& key, const Eigen::Vector2d& position,
              Span<const Eigen::Vector2d> near_path, std::vector<TileKey>* tiles) const;
  Eigen::AlignedBox2d Box(const TileKey& key) const;

  double finest_;
  int top_level_;
  std::vector<TileKey> roots_;
  std::vector<Eigen::Vector2d> path_;
};

/// Spacing `spacing` (m) is used within this distance (m) of the path: 1 cm and finer to 8 m, 4 cm
/// to 24 m, then as a pixel grows.
double PathReach(double spacing);
/// And within this distance of the rover, where a pixel spans four of it.
double RoverReach(double spacing);

}  // namespace regolith
