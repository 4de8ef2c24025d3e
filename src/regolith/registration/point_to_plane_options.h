// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct PointToPlaneOptions {
  int neighbours = 8;      ///< map points a plane is fitted to
  int min_neighbours = 5;  ///< fewer make no plane
  /// Spread of a neighbourhood across its plane over its second spread, standard deviations: more
  /// is no plane.
  double max_thickness_ratio = 0.4;
  /// Second over first spread within the plane: less is a line, whose normal is not determined.
  double min_width_ratio = 0.15;
  double search_again_distance = 0.02;  ///< m, a point that moved less keeps its plane
  double range_sigma = 0.02;            ///< m, floor of the residuals' scale; a plane is wider
  /// Residuals of neighbouring points share errors of the map: each counts as this share of an
  /// independent one.
  double independence = 0.02;

  /// Throws CheckError on values that match nothing.
  void Check() const;
};

}  // namespace regolith
