// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct KeyframeGraphOptions {
  bool close_loops = true;
  double distance = 0.3;        ///< m from one keyframe to the next …
  double angle = 0.2;           ///< … or rad
  double search_radius = 7.0;   ///< m around the newest keyframe, where old ones are looked for
  double min_age = 30.0;        ///< s; younger keyframes make no loop
  int interval = 5;             ///< keyframes between two attempts
  int submap_keyframes = 25;    ///< before and after the old one, that it is matched against
  double min_overlap = 0.6;     ///< share of the features that find a line or plane there
  double max_scale = 0.1;       ///< m, robust standard deviation of their distances, at most
  double max_correction = 2.0;  ///< m; what moves the newest keyframe farther is another place
  /// What one keyframe's motion from the last may be wrong by, and a loop's, 1 σ.
  double step_rotation_sigma = 0.002;  ///< rad
  double step_position_sigma = 0.01;   ///< m
  double loop_rotation_sigma = 0.005;  ///< rad
  double loop_position_sigma = 0.05;   ///< m

  /// Throws CheckError on values that make no graph.
  void Check() const;
};

}  // namespace regolith
