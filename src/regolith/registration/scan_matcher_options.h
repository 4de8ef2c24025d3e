// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/registration/point_to_plane_options.h"

namespace regolith {

struct ScanMatcherOptions {
  PointToPlaneOptions planes;
  int max_searches = 5;              ///< for the planes of the points
  int steps_per_search = 2;          ///< Gauss–Newton, with the planes held
  double rotation_tolerance = 1e-4;  ///< rad, a smaller change by new planes ends the search
  double position_tolerance = 1e-3;  ///< m
  int min_matches = 50;              ///< fewer leave the prior as it is
  /// Of the information about a direction over what the errors of the normals alone would make:
  /// less is none (RemoveDegenerateDirections; calibrated by simulation, docs/lidar.md).
  double degenerate_ratio = 2.0;

  /// Throws CheckError on values that make no match.
  void Check() const;
};

}  // namespace regolith
