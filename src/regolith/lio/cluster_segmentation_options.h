// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct ClusterSegmentationOptions {
  /// Degrees; two neighbours are of one thing where the line through them meets the farther beam at
  /// more than this (β of Bogoslavskyi & Stachniss 2016).
  double min_angle_deg = 60.0;
  int min_points = 30;        ///< smaller clusters are left out …
  int min_points_across = 5;  ///< … unless they have this many points in `min_rings` rings: poles
  int min_rings = 3;

  /// Throws CheckError on values that make no clusters.
  void Check() const;
};

}  // namespace regolith
