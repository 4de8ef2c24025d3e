// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/core/check.h"

namespace regolith {

/// How far wheels are trusted. Slip lasts as long as a slope does, so errors grow with distance and
/// angle, not with their roots.
struct WheelPreintegrationOptions {
  double distance_sigma_share = 0.1;  ///< of the distance: error along the track
  double lateral_sigma_share = 0.05;  ///< of the distance: error across the track
  /// Of the distance: error normal to the base's plane, which wheels do not see.
  double vertical_sigma_share = 0.3;
  double yaw_sigma_share = 0.15;       ///< of the angle turned
  double yaw_sigma_per_metre = 0.02;   ///< rad/m
  double tilt_sigma_per_metre = 0.3;   ///< rad/m: roll and pitch, which wheels do not see
  double floor_position_sigma = 2e-3;  ///< m, at rest
  double floor_rotation_sigma = 1e-3;  ///< rad, at rest

  void Check() const {
    REGOLITH_CHECK(floor_position_sigma > 0.0, "floor_position_sigma ", floor_position_sigma);
    REGOLITH_CHECK(floor_rotation_sigma > 0.0, "floor_rotation_sigma ", floor_rotation_sigma);
    for (const double share : {distance_sigma_share, lateral_sigma_share, vertical_sigma_share,
                               yaw_sigma_share, yaw_sigma_per_metre, tilt_sigma_per_metre}) {
      REGOLITH_CHECK(share >= 0.0, "share ", share);
    }
  }
};

}  // namespace regolith
