// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// How features take their distances from lidar returns.
struct LidarDepthOptions {
  double seconds = 12.0;        ///< scans are kept at least so long ...
  double metres = 6.0;          ///< ... and until the rover has gone so far
  double max_range = 25.0;      ///< m from the lidar; farther returns are not kept
  double spacing = 0.03;        ///< m between returns of one scan that are kept
  double search_angle = 0.03;   ///< rad around a feature's bearing within which returns count
  int max_returns = 30;         ///< of those, spread evenly, that a plane is laid through
  double max_thickness = 0.05;  ///< m, root mean square distance of the returns from it
  double max_incidence = 1.5;   ///< rad, between bearing and normal
  double depth_step = 0.15;  ///< share of the range; returns farther behind the nearest are hidden
  double sigma = 0.03;       ///< m, of a range, beside what the plane's errors make of it

  void Check() const {
    REGOLITH_CHECK(max_returns >= 3, "max_returns ", max_returns);
    for (const double positive : {seconds, metres, max_range, spacing, search_angle, max_thickness,
                                  max_incidence, depth_step, sigma}) {
      REGOLITH_CHECK(positive > 0.0, "value ", positive);
    }
  }
};

}  // namespace regolith
