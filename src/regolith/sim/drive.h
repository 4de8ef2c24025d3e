// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace regolith {

/// Where the rover's base is on the plane, as planned. Frame `map`, that of the surface.
struct PlanarPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double yaw = 0.0;                                    ///< rad, unwrapped
  double speed = 0.0;                                  ///< m/s, along the heading
};

/// A stretch on which the rover stays within kRevisitReach of its own earlier track.
struct Revisit {
  double start = 0.0;           ///< s
  double end = 0.0;             ///< s
  double length = 0.0;          ///< m, driven between the two
  bool same_direction = false;  ///< whether it faces the way it faced then
};

inline constexpr double kRevisitReach = 2.0;    ///< m
inline constexpr double kRevisitLength = 10.0;  ///< m; shorter stretches are crossings

/// A drive as planned.
struct Drive {
  std::vector<PlanarPose> path;  ///< at even intervals of time from 0 on
  double length = 0.0;           ///< m
  double steepest = 0.0;         ///< rad: the body's tilt or the ground's slope over 1 m ahead
  Eigen::Vector2d steepest_place = Eigen::Vector2d::Zero();  ///< m
  std::vector<Revisit> revisits;
  /// Centres (m) of the rocks that no way around exists for: a scene must leave them out.
  std::vector<Eigen::Vector2d> cleared;

  /// Whether the rock with this centre is one of `cleared`.
  bool Clears(const Eigen::Vector2d& centre) const {
    return std::find(cleared.begin(), cleared.end(), centre) != cleared.end();
  }
};

}  // namespace regolith
