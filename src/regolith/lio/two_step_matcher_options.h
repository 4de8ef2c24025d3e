// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

struct TwoStepMatcherOptions {
  double max_distance = 1.0;         ///< m, of a feature from the points it is matched to
  int max_searches = 10;             ///< for matches, in each of the two steps
  int steps_per_search = 2;          ///< Levenberg–Marquardt, with the matches held
  double range_sigma = 0.03;         ///< m, floor of the distances' scale
  double rotation_tolerance = 1e-4;  ///< rad, a smaller change by new matches ends a step
  double position_tolerance = 1e-3;  ///< m
  int min_matches = 10;              ///< fewer leave the guess as it is
  /// Mean squared projection of the matches on a direction below which it keeps the guess.
  double min_eigenvalue = 0.03;

  /// Throws CheckError on values that match nothing.
  void Check() const;
};

}  // namespace regolith
