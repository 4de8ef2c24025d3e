// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "regolith/sim/scenario_options.h"

namespace regolith {

/// One leg of a route before anything is known of the ground: an arc from `from` to `to` (m).
struct NominalLeg {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double bend = 0.0;      ///< rad, by which the heading turns left on the way
  int retraces = -1;      ///< index of the leg whose track this one follows; -1 for none
  bool reversed = false;  ///< it does so facing the other way

  /// Points of the arc, about `spacing` m apart, both ends included.
  std::vector<Eigen::Vector2d> Points(double spacing) const;
};

/// The legs of the route that `options` and `seed` ask for. Routes of the kinds `wander` and
/// `loops` start at the origin along x, and are to be placed; waypoints are taken as they are.
std::vector<NominalLeg> LayRoute(const DriveOptions& options, uint64_t seed);

/// Length (m) of a leg that takes DriveOptions::leg_duration.
double LegLength(const DriveOptions& options);

/// The box (m, about the origin, or about waypoints in frame `map`) that leaves room to place the
/// route of `options`: where ground is to be generated.
Eigen::AlignedBox2d DriveBox(const DriveOptions& options, uint64_t seed);

/// Shares of the nominal speed: what legs run at on average, and how far they vary around it. Ramps
/// and stops cost time, so that the mean over a drive is about the nominal speed.
inline constexpr double kMeanOfNominal = 1.14;
inline constexpr double kSpeedWaves = 0.04;
/// From rest to speed, s.
inline constexpr double kRamp = 1.0;

}  // namespace regolith
