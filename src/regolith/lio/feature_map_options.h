// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct FeatureMapOptions {
  double edge_spacing = 0.2;     ///< m between edge points, of a scan and of the map
  double planar_spacing = 0.3;   ///< m, of planar points
  double radius = 80.0;          ///< m, features farther from the lidar are forgotten
  double search_distance = 1.0;  ///< m, of a feature from the points of the map around it
  /// Where no plane lies within the search distance, one is looked for this much farther: the rings
  /// of a scan of 16 are metres apart on the ground.
  double coarse_growth = 3.0;
  int neighbours = 5;                ///< points that make a line or plane
  double line_ratio = 3.0;           ///< first over second variance of a line's points, at least
  double plane_thickness = 0.2;      ///< m, that a plane's points may lie off it; times the growth
  double plane_ratio = 0.1;          ///< second over first variance of a plane's points, at least
  double range_sigma = 0.03;         ///< m, floor of the distances' scale
  int max_searches = 10;             ///< for matches
  int steps_per_search = 2;          ///< Levenberg–Marquardt, with the matches held
  double rotation_tolerance = 1e-4;  ///< rad, a smaller change by new matches ends the search
  double position_tolerance = 1e-3;  ///< m
  int min_matches = 50;              ///< fewer leave the guess as it is
  /// Mean squared projection of the matches on a direction below which it keeps the guess.
  double min_eigenvalue = 1e-4;

  /// Throws CheckError on values that match nothing.
  void Check() const;
};

}  // namespace regolith
