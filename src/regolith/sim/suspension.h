// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/sim/scenario_options.h"
#include "regolith/terrain/rock_shapes.h"
#include "regolith/terrain/surface.h"

namespace regolith {

/// Rocks from this diameter on are driven around, smaller ones over.
inline constexpr double kObstacle = 0.15;  ///< m

/// How the body stands on its wheels.
struct Stance {
  double height = 0.0;  ///< m, of frame `base`
  double pitch = 0.0;   ///< rad, nose down positive (about y)
  double roll = 0.0;    ///< rad, left side up positive (about x)
  double travel = 0.0;  ///< m, of the wheel farthest from the body's level

  double Tilt() const;  ///< rad, from level
};

Eigen::Quaterniond FromYawPitchRoll(double yaw, double pitch, double roll);

/// Rocker suspension: each side's wheels carry a rocker (and, with six, a bogie behind), and a
/// differential keeps the body at the mean of both (Lindemann et al. 2006). Wheels are circles that
/// roll over the ground and over rocks smaller than kObstacle.
class Suspension {
 public:
  Suspension(const Surface& surface, const RoverOptions& options)
      : surface_(surface), options_(options), tops_(surface.RockShapes()) {}

  Stance At(const Eigen::Vector2d& position, double yaw);

  /// Slope (rad, absolute) of the ground over 1 m along `yaw`.
  double SlopeAhead(const Eigen::Vector2d& position, double yaw) const;

 private:
  struct Side {
    double height = 0.0;  ///< m, at the middle of the wheelbase
    double slope = 0.0;   ///< rise over run to the front
    double travel = 0.0;  ///< m, of the bogie
  };
  Side Rest(const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead);
  /// Height (m) of a wheel's lowest point when it touches.
  double Contact(const Eigen::Vector2d& wheel, const Eigen::Vector2d& ahead);
  /// Height (m) likewise, from one rock; below all ground where the wheel passes beside it.
  double ContactWithRock(const Rock& rock, const Eigen::Vector2d& wheel,
                         const Eigen::Vector2d& ahead) const;
  const std::vector<Rock>& RocksAround(const Eigen::Vector2d& place);

  const Surface& surface_;
  RoverOptions options_;
  RockTops tops_;
  std::unordered_map<int64_t, std::vector<Rock>> rocks_;  ///< by tile, those in reach of it
};

}  // namespace regolith
