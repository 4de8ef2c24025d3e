// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct GroundSegmentationOptions {
  /// Degrees; ground starts where, nearest to the lidar, it lies within this of the rover's level:
  /// what a rover tilts on rocks, and a street's camber.
  double seed_slope_deg = 25.0;
  double max_slope_deg = 40.0;  ///< degrees off the rover's level; steeper is no ground
  double max_bend_deg = 12.0;   ///< degrees between neighbouring stretches; ground bends no sharper
  double max_step = 0.03;  ///< share of the range between neighbours of a ring; more is an edge

  /// Throws CheckError on values that make no ground.
  void Check() const;
};

}  // namespace regolith
