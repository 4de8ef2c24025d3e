// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "regolith/terrain/surface.h"

namespace regolith {

/// What a planner needs to know of the ground, sampled tile by tile where it is asked.
class DriveMap {
 public:
  /// Ground steeper than `max_slope` (rad, over 1 m) is closed.
  DriveMap(const Surface& surface, double max_slope);

  /// Slope over 1 m (rise over run) relative to the steepest allowed; above 1 where a rover may
  /// not be: too steep, unknown or blocked.
  double Steepness(const Eigen::Vector2d& place);

  /// Closes what lies within `radius` m.
  void Block(const Eigen::Vector2d& place, double radius);

  /// Obstacles met by the wheels on a straight piece of track about `middle`, `length` m long; -1
  /// where one would touch the body.
  int TrackHits(const Eigen::Vector2d& middle, double yaw, double length);

  /// Obstacles that the wheels may meet when the rover turns on the spot; -1 as above.
  int TurnHits(const Eigen::Vector2d& place);

  /// Rocks of at least kObstacle that could touch a rover at `place`.
  const std::vector<Rock>& RocksNear(const Eigen::Vector2d& place);

 private:
  struct Tile {
    std::vector<float> steepness;         ///< by cell
    std::vector<std::vector<Rock>> bins;  ///< by square metre: rocks that reach a rover there
  };
  Tile& TileAt(const Eigen::Vector2d& place, Eigen::Vector2d* inside);
  Tile MakeTile(const Eigen::Vector2d& corner) const;
  void FillSteepness(const Eigen::Vector2d& corner, Tile* tile) const;

  const Surface& surface_;
  double max_rise_;
  std::unordered_map<int64_t, Tile> tiles_;
  int64_t last_key_ = -1;
  Tile* last_ = nullptr;
};

/// Whether a rock touches one of the wheels' tracks when the rover passes: its centre lies at
/// `aside` m (left positive) of the base's track.
bool OnWheelTrack(double aside, double diameter);

}  // namespace regolith
